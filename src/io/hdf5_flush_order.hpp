// SPDX-License-Identifier: BSD-3-Clause
// The order of writes in which a file of HDF5 is whole after each of them.
#pragma once

#include <hdf5.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace meniscus::hdf5 {

/// Bytes for a place in the file.
struct Change {
  H5FD_mem_t kind;  ///< what HDF5 keeps there
  haddr_t address;
  std::string bytes;

  haddr_t end() const { return address + bytes.size(); }
  bool covers(const Change& other) const {
    return address <= other.address && other.end() <= end();
  }
};

/// Puts into the bytes from `address` on what changes have of them, the later over the earlier.
void overlay(const std::vector<Change>& changes, haddr_t address, std::span<char> bytes);

/// What the order has to know of the file.
struct FileOnDisk {
  /// Bytes that are on the disk now.
  std::function<std::string(haddr_t address, std::size_t size)> read;
  /// Whether the file on the disk may refer to the place.
  std::function<bool(haddr_t begin, haddr_t end)> in_use;
  /// A place of so many bytes that nothing refers to before or after the flush, or HADDR_UNDEF.
  std::function<haddr_t(std::size_t size)> scratch;
};

/// Writes that bring `changes` to the disk, each within one page of the system (which a killed
/// process has either written or not) or of bytes that nothing refers to yet. After each of them
/// the file has all that was in it before, or all that is in it afterwards; what is new is referred
/// to last. Changes that overlap are made in the order in which they came. Source: HDF5 file format
/// specification 3.0, III.A.1 (trees), III.B, III.C (groups), III.D (heaps).
std::vector<Change> flush_order(const std::vector<Change>& changes, const FileOnDisk& file);

}  // namespace meniscus::hdf5
