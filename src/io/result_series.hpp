// SPDX-License-Identifier: BSD-3-Clause
// The files NAME.h5, NAME.1.h5, ... of a run with remaps, one per epoch, and NAME.vtkhdf.series,
// through which ParaView reads them as one.
#pragma once
#include "io/run_directory.hpp"
#include "io/xdmf.hpp"

#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// Files that describe the frames of all result files to viewers: NAME.xdmf, and NAME.vtkhdf.series
/// if there are several files.
class Sidecars {
 public:
  Sidecars(const std::filesystem::path& directory, const std::string& name)
      : xdmf_(directory / (name + ".xdmf")), series_(directory / (name + ".vtkhdf.series")) {}

  /// Adds frame k of a result file in the same directory. Frames must be added in order.
  void add_frame(const std::string& file, std::int64_t k, Real time, const FrameLayout& layout);
  /// Writes both files under temporary names and renames them. Throws FileError.
  void write() const;

 private:
  XdmfSidecar xdmf_;
  std::filesystem::path series_;
  std::vector<std::pair<std::string, Real>> files_;  // file and time of its first frame
};

/// Prepares the series for the file of an epoch. Files of earlier epochs stay, and their frames are
/// added to the sidecars. Files of later epochs are removed, because the run will write them again.
/// Returns the path of the file, which exists only if this epoch has already written it. Throws
/// FileError.
std::filesystem::path place_in_series(const RunDirectory& directory, const std::string& name,
                                      std::int64_t epoch, Sidecars& sidecars);

}  // namespace meniscus
