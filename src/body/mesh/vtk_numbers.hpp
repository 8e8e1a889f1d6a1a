// SPDX-License-Identifier: BSD-3-Clause
// Binary numbers in VTK's XML files. Source: VTK file formats, section "XML File Formats", and
// vtkXMLDataReader of VTK 9.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace meniscus {

/// How the numbers of a file are stored as bytes.
struct VtkStorage {
  int header_bytes = 4;     ///< size of a number in the header of an array, 4 or 8
  bool compressed = false;  ///< arrays are compressed by zlib, in blocks
};

/// Reads the bytes of an array from the front, in base64 or raw.
class VtkBytes {
 public:
  VtkBytes(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  /// The next `count` bytes. Throws InputError (without a place) if there are fewer.
  std::string read(std::uint64_t count);
  /// True if only space is left.
  bool ended();

 private:
  void decode_four_letters();

  std::string_view text_;  ///< the unread rest
  bool base64_;
  std::string decoded_;  ///< decoded bytes that were not read yet
};

/// Reads an array: its header and its `expected` bytes. Throws InputError (without a place) if the
/// array has another size or is damaged.
std::string read_stored(VtkBytes& bytes, std::uint64_t expected, const VtkStorage& storage);

}  // namespace meniscus
