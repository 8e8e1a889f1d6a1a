// SPDX-License-Identifier: BSD-3-Clause
// The files NAME.h5, NAME.1.h5, ... of a run whose bodies were referred anew, one per epoch, and
// NAME.vtkhdf.series, which names them to ParaView as one.
#pragma once
#include "io/run_directory.hpp"
#include "io/xdmf.hpp"

#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// What describes the frames of all files to viewers: NAME.xdmf, and NAME.vtkhdf.series if there is
/// more than one file.
class Sidecars {
 public:
  Sidecars(const std::filesystem::path& directory, const std::string& name)
      : xdmf_(directory / (name + ".xdmf")), series_(directory / (name + ".vtkhdf.series")) {}

  /// Frame k of a file in the same directory; frames follow each other.
  void add_frame(const std::string& file, std::int64_t k, Real time, const FrameLayout& layout);
  /// Writes each file whole and renames it into place. Throws FileError.
  void write() const;

 private:
  XdmfSidecar xdmf_;
  std::filesystem::path series_;
  std::vector<std::pair<std::string, Real>> files_;  // with the time of the first frame
};

/// Makes room in the series for the file of an epoch: those of earlier epochs stay, and their
/// frames are added to the sidecars; those of later ones are removed, for the run will make them
/// again. Returns the place of the file, which exists only if that epoch has one already. Throws
/// FileError.
std::filesystem::path place_in_series(const RunDirectory& directory, const std::string& name,
                                      std::int64_t epoch, Sidecars& sidecars);

}  // namespace meniscus
