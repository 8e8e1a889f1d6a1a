// SPDX-License-Identifier: BSD-3-Clause
// Orders the writes to an HDF5 file so that the file is valid after each of them.
#pragma once

#include <hdf5.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace meniscus::hdf5 {

/// Bytes to be written at an address of the file.
struct Change {
  H5FD_mem_t kind;  ///< kind of data that HDF5 stores there
  haddr_t address;
  std::string bytes;

  haddr_t end() const { return address + bytes.size(); }
  bool covers(const Change& other) const {
    return address <= other.address && other.end() <= end();
  }
};

/// Overwrites `bytes`, which begin at `address`, with the parts that changes cover. Later changes
/// win.
void overlay(const std::vector<Change>& changes, haddr_t address, std::span<char> bytes);

/// Access to the file while its writes are ordered.
struct FileOnDisk {
  /// Reads bytes from the disk.
  std::function<std::string(haddr_t address, std::size_t size)> read;
  /// True if the file on the disk may refer to these addresses.
  std::function<bool(haddr_t begin, haddr_t end)> in_use;
  /// Address of `size` bytes that nothing refers to before or after the flush, or HADDR_UNDEF.
  std::function<haddr_t(std::size_t size)> scratch;
};

/// Splits and orders `changes` into writes. Each write lies within one memory page (which a killed
/// process has written completely or not at all) or in bytes that nothing refers to yet. After each
/// write the file contains either all old or all new data; references to new data are written last.
/// If changes overlap, their order is kept. Source: HDF5 file format specification 3.0, III.A.1
/// (trees), III.B, III.C (groups), III.D (heaps).
std::vector<Change> flush_order(const std::vector<Change>& changes, const FileOnDisk& file);

}  // namespace meniscus::hdf5
