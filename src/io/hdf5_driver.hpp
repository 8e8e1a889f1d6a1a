// SPDX-License-Identifier: BSD-3-Clause
// HDF5 file driver: files that survive an interruption at any moment.
//
// HDF5 adds a frame by writing new structures and changing a few old ones (group index, superblock,
// array sizes), in an order of its own; a file whose writer is killed among these changes does not
// open. This driver gives out no place twice, and metadata only within pages of the system, which a
// killed process has written whole or not at all. It sends everything that lies where nothing was
// at the last flush straight to the disk, since nothing refers to it there, and keeps all other
// changes in memory. A flush makes them in an order in which each one is harmless without the next
// (hdf5_flush_order.hpp).
//
// HDF5 does not stand a write that fails (it crashes when the file is closed). The driver therefore
// never reports one: it notes the reason, leaves the file as it was at the last flush, and keeps in
// memory what comes later. Who flushes asks for write_error().
//
// Files are read through it, too: the buffer of metadata that HDF5 puts before its own driver
// copies beyond its end where a damaged file says so.
#pragma once
#include <cstdint>

namespace meniscus::hdf5 {

/// Makes files opened with the access properties `access` be read and written this way. Throws
/// FileError.
void use_ordered_writes(std::int64_t access);

/// Number (errno) of the first error in writing the open file `file`, 0 if there was none.
int write_error(std::int64_t file);

}  // namespace meniscus::hdf5
