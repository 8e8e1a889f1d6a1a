// SPDX-License-Identifier: BSD-3-Clause
// Units by name, and texts such as "72.8 mN/m" taken apart.
#include "quantity.hpp"

#include "meniscus/core/error.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

namespace meniscus {
namespace {

struct NamedUnit {
  std::string_view symbol;
  Unit unit;
  bool takes_prefix;
};

constexpr NamedUnit known_units[] = {
    {"m", {dimension::length}, true},
    {"s", {dimension::time}, true},
    {"g", {dimension::mass, -3}, true},
    {"N", {dimension::force}, true},
    {"Pa", {dimension::pressure}, true},
    {"J", {dimension::energy}, true},
    {"W", {dimension::power}, true},
    {"Hz", {dimension::rate}, true},
    {"L", {dimension::volume, -3}, true},
    {"min", {dimension::time, 0, 60}, false},
    {"h", {dimension::time, 0, 3600}, false},
    {"angstrom", {dimension::length, -10}, false},
    {"rad", {dimension::none}, false},
    {"deg", {dimension::none, 0, std::numbers::pi / 180}, false},
};

constexpr std::pair<std::string_view, int> prefixes[] = {
    {"z", -21},     {"a", -18}, {"f", -15}, {"p", -12}, {"n", -9}, {"u", -6}, {"\u00b5", -6},
    {"\u03bc", -6}, {"m", -3},  {"c", -2},  {"k", 3},   {"M", 6},  {"G", 9},  {"T", 12}};

constexpr std::string_view unit_list =
    "allowed are m, s, g, N, Pa, J, W, Hz, L (prefixes z a f p n u m c k M G T), min, h, angstrom, "
    "rad, deg";

/// The unit called `symbol`, prefix included; nothing if there is none.
const NamedUnit* find_unit(std::string_view symbol) {
  for (const NamedUnit& known : known_units)
    if (known.symbol == symbol) return &known;
  return nullptr;
}

}  // namespace

Unit unit_called(std::string_view symbol) {
  if (const NamedUnit* known = find_unit(symbol)) return known->unit;
  for (const auto& [prefix, tens] : prefixes) {
    if (!symbol.starts_with(prefix)) continue;
    const NamedUnit* known = find_unit(symbol.substr(prefix.size()));
    if (known == nullptr || !known->takes_prefix) continue;
    Unit unit = known->unit;
    unit.tens += tens;
    return unit;
  }
  throw InputError(fmt::format("unknown unit '{}'; {}", symbol, unit_list));
}

namespace {

/// Reads "number unit/(unit unit^2)" from left to right.
class QuantityReader {
 public:
  explicit QuantityReader(std::string_view text) : text_(text) {}

  /// The digits without their exponent, which is returned apart.
  std::pair<std::string_view, int> number() {
    skip_spaces();
    take('+');
    const std::size_t begin = position_;
    take('-');
    std::size_t digits = skip_digits();
    if (take('.')) digits += skip_digits();
    if (digits == 0) fail("does not begin with a number");
    return {text_.substr(begin, position_ - begin), exponent()};
  }

  Unit unit() {
    skip_spaces();
    if (at_end()) return {};
    take_one_over();
    const bool divide = take('/');
    if (!divide) take('*');
    const Unit unit = product(divide);
    if (!at_end()) fail("has a closing bracket too many");
    return unit;
  }

 private:
  static constexpr int max_depth = 8, max_power = 9, max_exponent = 1000;

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("'{}' {}", text_, what));
  }
  bool at_end() const { return position_ == text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[position_]; }
  bool take(char c) {
    if (at_end() || text_[position_] != c) return false;
    ++position_;
    return true;
  }
  void skip_spaces() {
    while (take(' ')) {
    }
  }
  /// The 1 of "1/s", as rates are written by symbol().
  void take_one_over() {
    if (text_.substr(position_).starts_with("1/")) ++position_;
  }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  std::size_t skip_digits() {
    const std::size_t begin = position_;
    while (is_digit(peek())) ++position_;
    return position_ - begin;
  }

  int exponent() {
    const std::size_t begin = position_;
    if (!take('e') && !take('E')) return 0;
    if (!take('+')) take('-');
    const std::size_t sign = text_[position_ - 1] == '-' ? position_ - 1 : position_;
    if (skip_digits() == 0) {  // the letter belongs to a unit
      position_ = begin;
      return 0;
    }
    int value = 0;
    const char* end = text_.data() + position_;
    if (std::from_chars(text_.data() + sign, end, value).ec != std::errc{} ||
        std::abs(value) > max_exponent)
      fail("has an exponent that is too large");
    return value;
  }

  Unit product(bool divide) {
    Unit result;
    for (bool divided = false;;) {
      multiply(result, factor(), divide ? -1 : 1);
      divided = divided || divide;
      skip_spaces();
      if (at_end() || peek() == ')') return result;
      divide = take('/');
      if (!divide && !take('*') && divided)
        fail("is ambiguous; expected the units of the divisor in brackets, e.g. kg/(m s^2)");
    }
  }

  Unit factor() {
    skip_spaces();
    Unit base;
    if (take('(')) {
      if (++depth_ > max_depth) fail("has too many brackets");
      base = product(false);
      if (!take(')')) fail("lacks a closing bracket");
      --depth_;
    } else {
      const std::size_t begin = position_;
      while (is_letter(peek())) ++position_;
      if (position_ == begin) fail("lacks a unit" + behind());
      base = unit_called(text_.substr(begin, position_ - begin));
      if (is_digit(peek())) fail("has a digit behind a unit; powers are written as m^3");
    }
    skip_spaces();
    if (!take('^')) return base;
    Unit result;
    multiply(result, base, power());
    return result;
  }

  /// Bytes of UTF-8 sequences count as letters (the micro sign).
  static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) > 127;
  }
  std::string behind() const {
    return position_ == 0 ? "" : fmt::format(" behind '{}'", text_.substr(0, position_));
  }

  int power() {
    const bool negative = take('-');
    const std::size_t begin = position_;
    if (skip_digits() != 1) fail(fmt::format("has a power that is not in -{0}...{0}", max_power));
    const int value = text_[begin] - '0';
    return negative ? -value : value;
  }

  void multiply(Unit& result, const Unit& by, int power) const {
    result.dimension.length += by.dimension.length * power;
    result.dimension.time += by.dimension.time * power;
    result.dimension.mass += by.dimension.mass * power;
    result.tens += by.tens * power;
    result.factor *= std::pow(by.factor, power);
    for (int value :
         {result.dimension.length, result.dimension.time, result.dimension.mass, result.tens})
      if (std::abs(value) > max_exponent) fail("has units of an absurd power");
  }

  std::string_view text_;
  std::size_t position_ = 0;
  int depth_ = 0;
};

}  // namespace

Quantity read_quantity(std::string_view text) {
  QuantityReader reader(text);
  const auto [digits, exponent] = reader.number();
  return {digits, exponent, reader.unit()};
}

}  // namespace meniscus
