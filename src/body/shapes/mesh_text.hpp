// SPDX-License-Identifier: BSD-3-Clause
// Words and numbers of a mesh file, with the lines they stand in.
#pragma once
#include "meniscus/core/error.hpp"
#include "meniscus/core/types.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace meniscus {

/// Reads from the beginning on. All members throw InputError with the name of the file and the
/// line.
class MeshText {
 public:
  MeshText(std::string_view text, std::string name, int line = 1)
      : text_(text), name_(std::move(name)), line_(line) {}

  /// The next word; `expected` is said if there is none.
  std::string_view word(std::string_view expected) {
    skip_space();
    word_line_ = line_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    if (at_ == begin) fail(fmt::format("the file ends; expected is {}", expected));
    return text_.substr(begin, at_ - begin);
  }
  bool ended() {
    skip_space();
    return at_ == text_.size();
  }
  /// In double quotes.
  std::string quoted(std::string_view expected) {
    skip_space();
    word_line_ = line_;
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
  /// Of the word read last.
  int line() const { return word_line_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: line {}: {}", name_, word_line_, what));
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  static std::string shown(std::string_view text) {
    std::string printable(text.substr(0, 40));
    for (char& c : printable)
      if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
    return printable + (text.size() > 40 ? "..." : "");
  }
  void skip_space() {
    for (; at_ < text_.size() && is_space(text_[at_]); ++at_) line_ += text_[at_] == '\n';
  }

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0;
  int line_ = 1, word_line_ = 1;
};

}  // namespace meniscus
