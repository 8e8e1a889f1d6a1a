// SPDX-License-Identifier: BSD-3-Clause
// Summaries of result files and checkpoints.
#include "io/info.hpp"

#include "input/text.hpp"
#include "io/files.hpp"
#include "io/hdf5_file.hpp"
#include "io/meta.hpp"
#include "io/run_directory.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

namespace meniscus {
namespace {

const char* type_name(hdf5::Type type) {
  switch (type) {
    case hdf5::Type::float32:
      return "float32";
    case hdf5::Type::float64:
      return "float64";
    case hdf5::Type::uint8:
      return "uint8";
    case hdf5::Type::int32:
      return "int32";
    case hdf5::Type::int64:
      return "int64";
    case hdf5::Type::text:
      return "text";
  }
  return "";
}

void describe_program(const hdf5::Group& root, std::string& out) {
  const hdf5::Group meta = root.group("meta");
  out += fmt::format("program   {}\n", read_program(root));
  out += fmt::format("started   {}, {} threads\n", meta.attribute_text("started_utc"),
                     meta.integer("threads"));
  out += fmt::format("command   {}\n", meta.attribute_text("command_line"));
  out += fmt::format("input     SHA-256 {}\n", meta.attribute_text("input_sha256"));
}

void describe_arrays(const hdf5::Group& group, std::string& out) {
  group.for_each_array([&](const std::string& name, const hdf5::ArrayInfo& info) {
    const std::string columns =
        info.shape.columns > 1 ? fmt::format(" x {}", info.shape.columns) : "";
    out += fmt::format("  {:<24} {:<8} {:>10}{:<5} {}\n", name, type_name(info.type),
                       info.shape.rows, columns, info.unit);
  });
}

void describe_bodies(const hdf5::Group& reference, std::string& out) {
  out += "bodies\n";
  for (const std::string& name : reference.names())
    out += fmt::format("  {:<24} {} particles\n", name, reference.group(name).integer("particles"));
}

/// Describes the frames of a file, whose numbers begin with `first_number`. Returns their number.
std::int64_t describe_frames(const hdf5::Group& steps, const std::string& time_unit,
                             std::int64_t first_number, std::string& out) {
  const auto name = [](std::int64_t k) { return fmt::format("{}", k); };
  std::int64_t frames = 0;
  while (steps.has(name(frames))) ++frames;
  if (frames > 0) {
    const hdf5::Group first = steps.group(name(0));
    out += "fields\n";
    for (const std::string& field : first.names()) {
      if (first.has_group(field)) continue;
      const hdf5::ArrayInfo info = first.info(field);
      out += fmt::format("  {:<24} {:<8} {} component{}, {}\n", field, type_name(info.type),
                         info.shape.columns, info.shape.columns > 1 ? "s" : "", info.unit);
    }
  }
  out += fmt::format("frames    {}\n", frames);
  for (std::int64_t k = 0; k < frames; ++k) {
    const hdf5::Group frame = steps.group(name(k));
    out += fmt::format("  {:<5} step {:<10} time {:<12.6g} {}{}\n", first_number + k,
                       frame.integer("step"), frame.real("time"), time_unit,
                       frame.has("state") ? "  with state" : "");
  }
  return frames;
}

std::int64_t describe_run(const hdf5::Group& root, std::int64_t first_number, std::string& out) {
  describe_program(root, out);
  describe_bodies(root.group("reference"), out);
  const std::string time_unit =
      root.has("VTKHDF") ? root.group("VTKHDF").info("Steps/Values").unit : "";
  return describe_frames(root.group("steps"), time_unit, first_number, out);
}

void describe_checkpoint(const hdf5::Group& root, std::string& out) {
  describe_program(root, out);
  out += fmt::format("step      {}\ntime      {:.17g}\nhash      {}\n", root.integer("step"),
                     root.real("time"), root.group("state").attribute_text("hash"));
  out += "state\n";
  describe_arrays(root.group("state"), out);
}

/// Describes a file; returns the number of its frames.
std::int64_t describe(const std::filesystem::path& path, std::int64_t first_number,
                      std::string& out) {
  const hdf5::File file = hdf5::File::open(path);
  const hdf5::Group root = file.root();
  out += fmt::format("file      {}\n", path.string());
  if (root.has("steps")) return describe_run(root, first_number, out);
  if (!root.has("state"))
    throw FileError(fmt::format("'{}' is neither a result file nor a checkpoint", path.string()));
  describe_checkpoint(root, out);
  return 0;
}

}  // namespace

std::string describe_file(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files{path};
  if (is_directory_there(path)) {
    files = result_series(path);
    if (files.empty()) files = {path / "run.h5"};  // reports the missing file
  }
  std::string text;
  std::int64_t frames = 0;
  for (const auto& file : files) frames += describe(file, frames, text);
  return printable(text);  // texts of a file must not control the terminal
}

}  // namespace meniscus
