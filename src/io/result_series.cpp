// SPDX-License-Identifier: BSD-3-Clause
// The order of files in a series of result files.
#include "io/result_series.hpp"

#include "io/files.hpp"
#include "io/vtkhdf.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

/// Adds the frames of a finished file to the sidecars.
void add_frames(const std::filesystem::path& path, const hdf5::Group& root, Sidecars& sidecars) {
  if (!root.has("VTKHDF")) return;  // the file has no frame
  const FrameLayout layout = vtkhdf::layout(root);
  const hdf5::Group steps = root.group("steps");
  for (std::int64_t k = 0; steps.has(fmt::format("{}", k)); ++k)
    sidecars.add_frame(path.filename().string(), k, steps.group(fmt::format("{}", k)).real("time"),
                       layout);
}

std::int64_t epoch_of(const hdf5::Group& root) {
  return root.has_attribute("epoch") ? root.integer("epoch") : 0;
}

}  // namespace

void Sidecars::add_frame(const std::string& file, std::int64_t k, Real time,
                         const FrameLayout& layout) {
  if (k == 0) files_.emplace_back(file, time);
  xdmf_.add_frame(file, k, time, layout);
}

void Sidecars::write() const {
  xdmf_.write();
  if (files_.size() < 2) {
    remove_file(series_);
    return;
  }
  std::string list;
  for (const auto& [name, time] : files_)
    list += fmt::format("{}    {{ \"name\": \"{}\", \"time\": {:.17g} }}",
                        list.empty() ? "" : ",\n", view_of(name).string(), time);
  replace_file(series_,
               "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n" + list + "\n  ]\n}\n");
}

std::filesystem::path place_in_series(const RunDirectory& directory, const std::string& name,
                                      std::int64_t epoch, Sidecars& sidecars) {
  const auto files = result_series(directory.path(), name);
  std::size_t earlier = 0;
  bool present = false;
  for (; earlier < files.size(); ++earlier) {
    const hdf5::File file = hdf5::File::open(files[earlier]);
    const hdf5::Group root = file.root();
    present = epoch_of(root) == epoch;
    if (epoch_of(root) >= epoch) break;
    add_frames(files[earlier], root, sidecars);
  }
  for (std::size_t k = files.size(); k > earlier + (present ? 1 : 0); --k)
    remove_result(files[k - 1]);
  return directory.result_file(earlier, name);
}

}  // namespace meniscus
