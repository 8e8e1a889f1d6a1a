// SPDX-License-Identifier: BSD-3-Clause
// run.xdmf: describes the frames of run.h5 to the XDMF readers of ParaView and VisIt. Each frame
// has its own arrays (the Xdmf3 reader shows nothing where parts of arrays are named).
#pragma once
#include "meniscus/core/types.hpp"

#include <filesystem>
#include <string>

#include "frame_layout.hpp"

namespace meniscus {

class XdmfSidecar {
 public:
  /// `path` is that of the sidecar; it names its HDF5 file, in the same directory, without a path.
  XdmfSidecar(std::filesystem::path path, std::string hdf5_name);

  void add_frame(std::int64_t k, Real time, const FrameLayout& layout);
  /// Writes the whole file and puts it in place in one step. Throws FileError.
  void write() const;

 private:
  std::string data_item(const std::string& array, std::int64_t rows, int columns,
                        hdf5::Type type) const;

  std::filesystem::path path_;
  std::string hdf5_name_;
  std::string frames_;
};

}  // namespace meniscus
