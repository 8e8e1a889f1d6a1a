// SPDX-License-Identifier: BSD-3-Clause
// Text functions: shortening, joining, and making texts safe to print.
#include "input/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

namespace meniscus {
namespace {

struct Character {
  std::uint32_t code;  ///< 0 if the bytes are no UTF-8
  std::size_t bytes;
};

/// Decodes the first character of a text that is not empty.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t bytes = byte(0) < 0x80   ? 1
                            : byte(0) < 0xc2 ? 0
                            : byte(0) < 0xe0 ? 2
                            : byte(0) < 0xf0 ? 3
                            : byte(0) < 0xf5 ? 4
                                             : 0;
  if (bytes == 0 || bytes > text.size()) return {0, 1};
  if (bytes == 1) return {byte(0), 1};
  std::uint32_t code = byte(0) & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return {0, 1};
    code = (code << 6U) | (byte(i) & 0x3fU);
  }
  const bool too_long = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000),
             surrogate = code >= 0xd800 && code <= 0xdfff;
  return too_long || surrogate || code > 0x10ffff ? Character{0, 1} : Character{code, bytes};
}

/// True for characters that must not reach a terminal: control characters (C0, C1), invisible
/// characters, and characters that change the direction of writing.
bool commands_terminals(std::uint32_t code) {
  if (code == '\n' || code == '\t') return false;
  constexpr std::pair<std::uint32_t, std::uint32_t> ranges[] = {
      {0x00, 0x1f},     {0x7f, 0x9f},     {0xad, 0xad},     {0x61c, 0x61c},   {0x200b, 0x200f},
      {0x2028, 0x202e}, {0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe007f}};
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [&](const auto& r) { return code >= r.first && code <= r.second; });
}

/// The text; if it is longer than `most` bytes, its beginning and its end.
std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  const auto in_character = [&](std::size_t i) {
    return (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U;
  };
  std::size_t head = most * 2 / 3, tail = text.size() - most / 4;
  while (head > 0 && in_character(head)) --head;
  while (tail < text.size() && in_character(tail)) ++tail;
  return fmt::format("{} ... ({} characters) ... {}", text.substr(0, head), text.size(),
                     text.substr(tail));
}

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Shortens each long quotation in single quotes. A quote within a word, as in "isn't", does not
/// open or close a quotation.
std::string with_short_quotations(std::string_view line) {
  constexpr std::size_t most = 400;  // paths are usually shorter
  const auto next_quote = [&](std::size_t from, bool opens) {
    for (std::size_t i = from; i < line.size(); ++i) {
      const bool beside = opens ? i > 0 && is_letter_or_digit(line[i - 1])
                                : i + 1 < line.size() && is_letter_or_digit(line[i + 1]);
      if (line[i] == '\'' && !beside) return i;
    }
    return line.npos;
  };
  std::string result;
  std::size_t done = 0;
  for (;;) {
    const std::size_t open = next_quote(done, true),
                      close = open == line.npos ? open : next_quote(open + 1, false);
    if (close == line.npos) return result += line.substr(done);
    result += line.substr(done, open + 1 - done);
    result += shortened(line.substr(open + 1, close - open - 1), most);
    result += '\'';
    done = close + 1;
  }
}

}  // namespace

std::string joined(const std::vector<std::string>& items, std::string_view separator) {
  std::string text;
  for (const std::string& item : items) {
    if (&item != &items.front()) text += separator;
    text += item;
  }
  return text;
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto [code, bytes] = first_character(text);
    if (commands_terminals(code))
      result += '?';
    else
      result += text.substr(0, bytes);
    text.remove_prefix(bytes);
  }
  return result;
}

std::string readable(std::string_view message) {
  constexpr std::size_t longest_line = 8000;
  const std::string plain = printable(message);
  std::string result;
  for (std::string_view rest = plain;;) {
    const std::size_t end = rest.find('\n');
    result += shortened(with_short_quotations(rest.substr(0, end)), longest_line);
    if (end == rest.npos) return result;
    result += '\n';
    rest.remove_prefix(end + 1);
  }
}

}  // namespace meniscus
