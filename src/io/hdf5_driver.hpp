// SPDX-License-Identifier: BSD-3-Clause
// HDF5 file driver: files that survive an interruption at any moment.
//
// To add a frame, HDF5 writes new structures and changes a few old ones (group index, superblock,
// array sizes) in an order that it chooses itself. If the writer is killed between these changes,
// the file does not open. This driver never allocates an address twice, and keeps metadata within
// memory pages, which a killed process has written completely or not at all. Bytes at addresses
// that were unused at the last flush are written at once, since nothing on the disk refers to them.
// All other changes stay in memory. A flush writes them in an order in which the file is valid
// after each write (hdf5_flush_order.hpp).
//
// HDF5 cannot handle a failed write: it crashes when the file is closed. The driver therefore never
// reports a failure to HDF5. It remembers the error, leaves the file as it was at the last flush,
// and keeps later writes in memory. The caller of a flush must check write_error().
//
// Files are also read through this driver: the metadata buffer of HDF5's own driver copies beyond
// its end if a damaged file contains a wrong size.
#pragma once
#include <cstdint>

namespace meniscus::hdf5 {

/// Makes all files opened with the access properties `access` use this driver. Throws FileError.
void use_ordered_writes(std::int64_t access);

/// Number (errno) of the first error in writing the open file `file`, 0 if there was none.
int write_error(std::int64_t file);

}  // namespace meniscus::hdf5
