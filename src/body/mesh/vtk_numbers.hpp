// SPDX-License-Identifier: BSD-3-Clause
// Numbers of VTK's XML files that are stored as bytes. Source: VTK file formats, section "XML File
// Formats", and vtkXMLDataReader of VTK 9.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace meniscus {

/// How the numbers of a file are stored as bytes.
struct VtkStorage {
  int header_bytes = 4;     ///< of each number in the header of an array, 4 or 8
  bool compressed = false;  ///< by zlib, in blocks
};

/// The bytes of an array, in base64 or as they are, read from the front.
class VtkBytes {
 public:
  VtkBytes(std::string_view text, bool base64) : text_(text), base64_(base64) {}

  /// Throws InputError, without a place, if there are less.
  std::string read(std::uint64_t count);
  /// Whether nothing but space is left.
  bool ended();

 private:
  void decode_four_letters();

  std::string_view text_;  ///< what is left
  bool base64_;
  std::string decoded_;  ///< of the last four letters, what was not asked for yet
};

/// The `expected` bytes of an array, whose header comes first. Throws InputError, without a place,
/// if they are more or less, or damaged.
std::string read_stored(VtkBytes& bytes, std::uint64_t expected, const VtkStorage& storage);

}  // namespace meniscus
