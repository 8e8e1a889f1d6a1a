// SPDX-License-Identifier: BSD-3-Clause
// run.xdmf: describes the frames of run.h5, run.1.h5, ... to the XDMF readers of ParaView and
// VisIt. Each frame has its own arrays, because the Xdmf3 reader shows nothing if parts of arrays
// are named.
#pragma once
#include "io/frame_layout.hpp"
#include "numbers/types.hpp"

#include <filesystem>
#include <string>
#include <utility>

namespace meniscus {

class XdmfSidecar {
 public:
  explicit XdmfSidecar(std::filesystem::path path) : path_(std::move(path)) {}

  /// Adds frame k of an HDF5 file in the directory of the sidecar.
  void add_frame(const std::string& hdf5_name, std::int64_t k, Real time,
                 const FrameLayout& layout);
  /// Writes the file under a temporary name and renames it. Throws FileError.
  void write() const;

 private:
  std::filesystem::path path_;
  std::string frames_;
};

}  // namespace meniscus
