// SPDX-License-Identifier: BSD-3-Clause
// HDF5 number types and text attributes, shared by the HDF5 files.
#pragma once
#include "io/hdf5_file.hpp"

#include <hdf5.h>

#include <string>
#include <type_traits>

namespace meniscus::hdf5 {

template <class T>
hid_t memory_type() {
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, std::int64_t>);
  return std::is_same_v<T, double> ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
}

/// Size of the file that contains an open object, in bytes.
std::uint64_t file_size(std::int64_t object);

/// The stored type: little-endian on every machine.
hid_t file_type(Type type);

/// The type of a text of this length, both stored and in memory.
Handle text_type(const std::string& text);

/// Sets or replaces an attribute of a group or an array.
void write_text_attribute(std::int64_t object, const std::string& name, const std::string& text);
std::string read_text_attribute(std::int64_t object, const std::string& name);

}  // namespace meniscus::hdf5
