// SPDX-License-Identifier: BSD-3-Clause
// Reads words and numbers of a mesh file and remembers their lines for messages.
#pragma once
#include "meniscus/error.hpp"
#include "numbers/types.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

namespace meniscus {

/// Reads a text from its beginning. All members throw InputError with the name of the file and the
/// line.
class MeshText {
 public:
  MeshText(std::string_view text, std::string name, int line = 1)
      : text_(text), name_(std::move(name)), line_(line) {}

  /// The next word. If there is none, the message names `expected`.
  std::string_view word(std::string_view expected) {
    skip_space();
    begin_word();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    if (at_ == begin) fail(fmt::format("the file ends; expected is {}", expected));
    return text_.substr(begin, at_ - begin);
  }
  bool ended() {
    skip_space();
    return at_ == text_.size();
  }
  /// The next text in double quotes.
  std::string quoted(std::string_view expected) {
    skip_space();
    begin_word();
    const std::size_t end = at_ < text_.size() ? text_.find('"', at_ + 1) : text_.npos;
    if (at_ == text_.size() || text_[at_] != '"' || end == text_.npos)
      fail(fmt::format("expected is {} in double quotes", expected));
    const std::string inner(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return inner;
  }
  long integer(std::string_view expected, long least = std::numeric_limits<long>::min(),
               long most = std::numeric_limits<long>::max()) {
    const std::string_view text = word(expected);
    long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      fail(fmt::format("'{}' is no integer; expected is {}", shown(text), expected));
    return in_range(value, expected, least, most);
  }
  long in_range(long value, std::string_view expected, long least, long most) const {
    if (value < least || value > most)
      fail(fmt::format("{} is out of range; expected is {}", value, expected));
    return value;
  }
  Real real(std::string_view expected) {
    const std::string_view text = word(expected);
    Real value = 0;
    const char* begin = text.data() + (text.front() == '+' ? 1 : 0);
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
      fail(fmt::format("'{}' is no finite number; expected is {}", shown(text), expected));
    return value;
  }
  /// The next number, stored as bytes. From here on messages name bytes, because lines have no
  /// meaning.
  template <class T>
  T bytes_of(std::string_view expected) {
    static_assert(std::endian::native == std::endian::little);
    bytes_ = true;
    begin_word();
    if (text_.size() - at_ < sizeof(T))
      fail(fmt::format("the file ends; expected is {}", expected));
    T value;
    std::memcpy(&value, text_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  /// Moves on to the next line. The rest of this line may contain only space.
  void skip_line_end() {
    while (at_ < text_.size() && is_space(text_[at_]))
      if (text_[at_++] == '\n') {
        ++line_;
        return;
      }
    begin_word();
    fail("expected is the end of the line, behind which bytes begin");
  }
  /// Moves on behind the next `end`, which stands on a line of its own or follows bytes at once.
  void skip_past(const std::string& end) {
    begin_word();
    const std::size_t found = text_.find(end, at_);
    if (found == text_.npos) fail(fmt::format("the file ends; expected is {}", end));
    const std::size_t next = found + end.size();
    line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                         text_.begin() + static_cast<std::ptrdiff_t>(next), '\n'));
    at_ = next;
  }
  /// Place of the last word or number, for messages: "line 17" or "byte 1234".
  std::string place() const {
    return bytes_ ? fmt::format("byte {}", word_begin_) : fmt::format("line {}", word_line_);
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}: {}", name_, place(), what));
  }
  /// The beginning of a text as a message can show it: at most 40 printable characters.
  static std::string shown(std::string_view text) {
    std::string printable(text.substr(0, 40));
    for (char& c : printable)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    return printable + (text.size() > 40 ? "..." : "");
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void begin_word() {
    word_line_ = line_;
    word_begin_ = at_;
  }
  void skip_space() {
    for (; at_ < text_.size() && is_space(text_[at_]); ++at_) line_ += text_[at_] == '\n';
  }

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0, word_begin_ = 0;
  int line_ = 1, word_line_ = 1;
  bool bytes_ = false;  ///< numbers were read as bytes
};

}  // namespace meniscus
