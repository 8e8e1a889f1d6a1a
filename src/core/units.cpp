// SPDX-License-Identifier: BSD-3-Clause
// Physical dimensions and the unit system of a scene.
#include "meniscus/core/units.hpp"

#include "meniscus/core/error.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <utility>

namespace meniscus {
namespace {

/// `factor` * 10^`tens` in SI. Powers of ten are kept apart so that they stay exact.
struct Unit {
  Dimension dimension;
  int tens = 0;
  Real factor = 1;
};

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

constexpr std::pair<Dimension, std::string_view> dimension_names[] = {
    {dimension::none, "a plain number"}, {dimension::length, "a length"},
    {dimension::area, "an area"},        {dimension::volume, "a volume"},
    {dimension::time, "a time"},         {dimension::rate, "a rate"},
    {dimension::velocity, "a velocity"}, {dimension::acceleration, "an acceleration"},
    {dimension::mass, "a mass"},         {dimension::density, "a density"},
    {dimension::pressure, "a pressure"}, {dimension::viscosity, "a viscosity"},
    {dimension::tension, "a tension"},   {dimension::force, "a force"},
    {dimension::energy, "an energy"},    {dimension::power, "a power"},
    {dimension::momentum, "a momentum"}, {dimension::angular_momentum, "an angular momentum"},
};

/// The unit called `symbol`, prefix included; nothing if there is none.
const NamedUnit* find_unit(std::string_view symbol) {
  for (const NamedUnit& known : known_units)
    if (known.symbol == symbol) return &known;
  return nullptr;
}

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

/// Products of base units as text: mass, length, time; those with negative powers below the bar.
std::string composed(Dimension d, std::string_view length, std::string_view time,
                     std::string_view mass) {
  std::string above, below;
  int divisors = 0;
  const auto append = [&](std::string_view symbol, int power) {
    if (power == 0) return;
    if (power < 0) ++divisors;
    std::string& side = power > 0 ? above : below;
    if (!side.empty()) side += ' ';
    side += symbol;
    if (std::abs(power) != 1) side += fmt::format("^{}", std::abs(power));
  };
  append(mass, d.mass);
  append(length, d.length);
  append(time, d.time);
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return above + (divisors > 1 ? "/(" + below + ")" : "/" + below);
}

/// "a pressure (kg/(m s^2))": always in base units, so that two of them can be compared.
std::string name_of(Dimension d) {
  for (const auto& [known, name] : dimension_names)
    if (known == d)
      return d == dimension::none ? std::string(name)
                                  : fmt::format("{} ({})", name, composed(d, "m", "s", "kg"));
  return fmt::format("a quantity in {}", composed(d, "m", "s", "kg"));
}

/// digits * 10^tens, correctly rounded.
Real decimal(std::string_view digits, int tens) {
  const std::string text = fmt::format("{}e{}", digits, tens);
  Real value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    throw InputError(fmt::format("the number {} is too large or too small", text));
  return value;
}

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
        fail("is ambiguous; put the units of the divisor in brackets, e.g. kg/(m s^2)");
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

UnitSystem::UnitSystem(std::string_view name) : name_(name), length_{"m"}, time_{"s"}, mass_{"kg"} {
  if (name == "SI") return;
  const auto refuse = [&](const std::string& reason) {
    throw InputError(fmt::format(
        "unknown unit system '{}': {}; allowed are \"SI\" and a length-time-mass triple such as "
        "\"nm-ps-ag\"",
        name, reason));
  };
  std::string_view rest = name;
  const auto next = [&](Dimension expected, bool last) {
    const std::size_t dash = rest.find('-');
    if (last != (dash == std::string_view::npos)) refuse("three units joined by '-' are needed");
    const std::string_view symbol = rest.substr(0, dash);
    rest.remove_prefix(last ? rest.size() : dash + 1);
    Unit unit;
    try {
      unit = unit_called(symbol);
    } catch (const InputError& error) {
      refuse(error.what());
    }
    if (unit.dimension != expected)
      refuse(fmt::format("'{}' is {}, expected {}", symbol, name_of(unit.dimension),
                         name_of(expected)));
    return Base{std::string(symbol), unit.tens, unit.factor};
  };
  length_ = next(dimension::length, false);
  time_ = next(dimension::time, false);
  mass_ = next(dimension::mass, true);
}

int UnitSystem::tens(Dimension d) const {
  return d.length * length_.tens + d.time * time_.tens + d.mass * mass_.tens;
}

Real UnitSystem::factor(Dimension d) const {
  return std::pow(length_.factor, d.length) * std::pow(time_.factor, d.time) *
         std::pow(mass_.factor, d.mass);
}

Real UnitSystem::quantity(std::string_view text, Dimension expected) const {
  QuantityReader reader(text);
  const auto [digits, exponent] = reader.number();
  const Unit unit = reader.unit();
  if (unit.dimension != expected) {
    if (unit.dimension == dimension::none)
      throw InputError(
          fmt::format("'{}' has no unit, expected {}; a number in {} is written without quotes",
                      text, name_of(expected), symbol(expected)));
    throw InputError(
        fmt::format("'{}' is {}, expected {}", text, name_of(unit.dimension), name_of(expected)));
  }
  return decimal(digits, exponent + unit.tens - tens(expected)) * (unit.factor / factor(expected));
}

std::string UnitSystem::symbol(Dimension d) const {
  static constexpr std::pair<Dimension, std::string_view> derived[] = {
      {dimension::pressure, "Pa"}, {dimension::viscosity, "Pa s"}, {dimension::tension, "N/m"},
      {dimension::force, "N"},     {dimension::energy, "J"},       {dimension::power, "W"}};
  if (name_ == "SI")
    for (const auto& [known, symbol] : derived)
      if (known == d) return std::string(symbol);
  return composed(d, length_.symbol, time_.symbol, mass_.symbol);
}

Real UnitSystem::in_si(Dimension d) const {
  return decimal("1", tens(d)) * factor(d);
}

}  // namespace meniscus
