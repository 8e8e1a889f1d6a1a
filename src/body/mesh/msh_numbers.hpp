// SPDX-License-Identifier: BSD-3-Clause
// Reads the numbers of a Gmsh mesh, which are text or bytes, as the header of the file states.
#pragma once
#include "body/mesh/mesh_text.hpp"

#include <cstdint>

namespace meniscus {

/// Words are text in both kinds of files. In binary files, integers have 4 bytes, sizes (of version
/// 4.1) 8 and reals 8, in the byte order of this machine. All members throw InputError with the
/// file and the line, or the byte.
class MshNumbers {
 public:
  MshNumbers(std::string_view text, const std::string& name) : text_(text, name) {}

  MeshText& text() { return text_; }
  bool binary() const { return binary_; }
  /// Switches to binary numbers.
  void set_binary() { binary_ = true; }
  /// In a binary file, skips the end of the line after which bytes begin.
  void begin_bytes() {
    if (binary_) text_.skip_line_end();
  }

  long integer(std::string_view expected, long least = std::numeric_limits<long>::min(),
               long most = std::numeric_limits<long>::max()) {
    if (!binary_) return text_.integer(expected, least, most);
    return text_.in_range(text_.bytes_of<std::int32_t>(expected), expected, least, most);
  }
  long size(std::string_view expected, long least = std::numeric_limits<long>::min(),
            long most = std::numeric_limits<long>::max()) {
    if (!binary_) return text_.integer(expected, least, most);
    return text_.in_range(text_.bytes_of<std::int64_t>(expected), expected, least, most);
  }
  Real real(std::string_view expected) {
    if (!binary_) return text_.real(expected);
    const auto value = text_.bytes_of<double>(expected);
    if (!std::isfinite(value))
      text_.fail(fmt::format("{} is no finite number; expected is {}", value, expected));
    return value;
  }
  /// Place of the last number, for messages: "line 17" or "byte 1234".
  std::string place() const { return text_.place(); }
  [[noreturn]] void fail(const std::string& what) const { text_.fail(what); }

 private:
  MeshText text_;
  bool binary_ = false;
};

}  // namespace meniscus
