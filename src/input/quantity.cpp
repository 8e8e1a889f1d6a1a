// SPDX-License-Identifier: BSD-3-Clause
// Units by name, and quantities such as "72.8 mN/m" parsed into number and unit.
#include "input/quantity.hpp"

#include "input/names.hpp"
#include "input/text.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace meniscus {
namespace {

struct NamedUnit {
  std::string_view symbol;
  Unit unit;
  bool takes_prefix;
};

/// kT is k T with k = 1.380649e-23 J/K at 25 degrees Celsius, the 4.11 pN nm of textbooks.
constexpr NamedUnit known_units[] = {
    {"m", {dimension::length}, true},
    {"s", {dimension::time}, true},
    {"g", {dimension::mass, -3}, true},
    {"N", {dimension::force}, true},
    {"dyn", {dimension::force, -5}, true},
    {"Pa", {dimension::pressure}, true},
    {"bar", {dimension::pressure, 5}, true},
    {"P", {dimension::viscosity, -1}, true},
    {"J", {dimension::energy}, true},
    {"eV", {dimension::energy, -19, 1.602176634}, true},
    {"W", {dimension::power}, true},
    {"Hz", {dimension::rate}, true},
    {"L", {dimension::volume, -3}, true},
    {"atm", {dimension::pressure, 0, 101325}, false},
    {"psi", {dimension::pressure, 0, 6894.757293168361}, false},
    {"mmHg", {dimension::pressure, 0, 133.322387415}, false},
    {"erg", {dimension::energy, -7}, false},
    {"kT", {dimension::energy, -23, 1.380649 * 298.15}, false},
    {"min", {dimension::time, 0, 60}, false},
    {"h", {dimension::time, 0, 3600}, false},
    {"angstrom", {dimension::length, -10}, false},
    {"rad", {dimension::none, 0, 1, 1}, false},
    {"deg", {dimension::none, 0, degree, 1}, false},
};

constexpr std::pair<std::string_view, int> prefixes[] = {
    {"z", -21},     {"a", -18}, {"f", -15}, {"p", -12}, {"n", -9}, {"u", -6}, {"\u00b5", -6},
    {"\u03bc", -6}, {"m", -3},  {"c", -2},  {"k", 3},   {"M", 6},  {"G", 9},  {"T", 12}};

/// Other common names of units, in lower case.
constexpr std::pair<std::string_view, std::string_view> other_names[] = {
    {"micron", "um"},       {"microns", "um"}, {"meter", "m"},
    {"metre", "m"},         {"a", "angstrom"}, {"\u00c5", "angstrom"},
    {"\u212b", "angstrom"}, {"sec", "s"},      {"second", "s"},
    {"seconds", "s"},       {"minute", "min"}, {"minutes", "min"},
    {"hour", "h"},          {"hours", "h"},    {"hr", "h"},
    {"gram", "g"},          {"newton", "N"},   {"pascal", "Pa"},
    {"joule", "J"},         {"watt", "W"},     {"hertz", "Hz"},
    {"liter", "L"},         {"litre", "L"},    {"poise", "P"},
    {"dyne", "dyn"},        {"ergs", "erg"},   {"kbt", "kT"},
    {"electronvolt", "eV"}, {"radian", "rad"}, {"degree", "deg"},
    {"degrees", "deg"},     {"\u00b0", "deg"}, {"cps", "cP"},
};

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

std::string small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

/// The unit called `symbol` without a prefix; nothing if there is none.
const NamedUnit* find_unit(std::string_view symbol) {
  for (const NamedUnit& known : known_units)
    if (known.symbol == symbol) return &known;
  return nullptr;
}

std::optional<Unit> find_prefixed(std::string_view symbol) {
  if (const NamedUnit* known = find_unit(symbol)) return known->unit;
  for (const auto& [prefix, tens] : prefixes) {
    if (!symbol.starts_with(prefix)) continue;
    const NamedUnit* known = find_unit(symbol.substr(prefix.size()));
    if (known == nullptr || !known->takes_prefix) continue;
    Unit unit = known->unit;
    unit.tens += tens;
    return unit;
  }
  return std::nullopt;
}

/// All unit symbols that can be typed, including prefixes.
std::vector<std::string> all_symbols() {
  std::vector<std::string> symbols;
  for (const NamedUnit& unit : known_units) {
    symbols.emplace_back(unit.symbol);
    for (const auto& [prefix, tens] : prefixes)
      if (unit.takes_prefix && is_ascii(prefix))
        symbols.push_back(std::string(prefix) + std::string(unit.symbol));
  }
  return symbols;
}

/// Units that the author of `symbol` may have meant: another name of a unit, two units in one word
/// ("Nm"), another case, or one wrong letter.
std::vector<std::string> near_units(std::string_view symbol) {
  std::vector<std::string> near;
  const std::string small = small_letters(symbol);
  for (const auto& [name, unit] : other_names)
    if (name == small) near.emplace_back(unit);
  for (std::size_t i = symbol.size(); near.empty() && i-- > 1;)
    if (is_unit(symbol.substr(0, i)) && is_unit(symbol.substr(i)))
      near.push_back(fmt::format("{} {}", symbol.substr(0, i), symbol.substr(i)));
  const std::vector<std::string> known = all_symbols();
  for (const std::string& unit : known)
    if (small_letters(unit) == small) near.push_back(unit);
  constexpr std::size_t shortest = 3, longest = 16;  // lengths of texts that may be misspelt
  if (!near.empty() || symbol.size() < shortest || symbol.size() > longest) return near;
  for (const std::string& unit : known)
    if (near.size() < 3 && unit.size() > 1 && edit_distance(symbol, unit) == 1)
      near.push_back(unit);
  return near;
}

}  // namespace

std::string unit_list() {
  std::vector<std::string> prefixed, letters, others;
  for (const NamedUnit& known : known_units)
    (known.takes_prefix ? prefixed : others).emplace_back(known.symbol);
  for (const auto& [prefix, tens] : prefixes)
    if (is_ascii(prefix)) letters.emplace_back(prefix);
  return fmt::format("{} (prefixes {}), {}", joined(prefixed, ", "), joined(letters, " "),
                     joined(others, ", "));
}

bool is_unit(std::string_view symbol) {
  return find_prefixed(symbol).has_value();
}

Unit unit_called(std::string_view symbol) {
  if (const auto unit = find_prefixed(symbol)) return *unit;
  const std::vector<std::string> near = near_units(symbol);
  throw InputError(
      fmt::format("unknown unit '{}'; allowed are {}{}", symbol, unit_list(),
                  near.empty() ? "" : "; did you mean '" + joined(near, "' or '") + "'?"));
}

namespace {

/// Reads "number unit/(unit unit^2)" from left to right.
class QuantityReader {
 public:
  explicit QuantityReader(std::string_view text) : text_(text) {}

  /// The digits of a number, and its exponent separately.
  std::pair<std::string_view, int> number() {
    skip_spaces();
    take('+');
    const std::size_t begin = position_;
    take('-');
    std::size_t digits = skip_digits();
    if (take('.')) digits += skip_digits();
    if (digits > 0 && peek() == ',') fail("has a decimal comma; decimals take a point, as in 0.5");
    if (digits == 0) fail("does not begin with a number");
    return {text_.substr(begin, position_ - begin), exponent()};
  }

  Unit unit() {
    skip_spaces();
    if (at_end()) return {};
    take_one_over();
    const bool divide = take('/');
    if (!divide) take_times();
    const Unit unit = product(divide);
    if (!at_end()) fail("has a closing bracket too many");
    return unit;
  }

 private:
  static constexpr std::string_view raised_digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3",
                                                       "\u2074", "\u2075", "\u2076", "\u2077",
                                                       "\u2078", "\u2079"};
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
  /// Skips the 1 of "1/s"; symbol() writes rates in this way.
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
      if (!divide && !take_times() && divided)
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
      const std::string_view symbol = letters();
      if (symbol.empty()) fail("lacks a unit" + behind());
      base = unit_called(symbol);
      if (power_follows()) return raised(base, power());  // powers without ^, such as m3, s-1
    }
    if (const auto raise = superscript()) return raised(base, *raise);
    skip_spaces();
    return take('^') ? raised(base, power()) : base;
  }

  Unit raised(const Unit& base, int power) const {
    Unit result;
    multiply(result, base, power);
    return result;
  }

  bool take(std::string_view sign) {
    if (!text_.substr(position_).starts_with(sign)) return false;
    position_ += sign.size();
    return true;
  }
  /// Reads a sign of multiplication: a star, or a raised dot as in copied texts.
  bool take_times() { return take('*') || take("\u00b7") || take("\u22c5"); }

  /// Reads a power in superscript digits.
  std::optional<int> superscript() {
    const bool negative = take("\u207b");
    for (std::size_t value = 0; value < std::size(raised_digits); ++value)
      if (take(raised_digits[value]))
        return negative ? -static_cast<int>(value) : static_cast<int>(value);
    if (negative) fail("lacks a power" + behind());
    return std::nullopt;
  }

  /// Reads ASCII letters and any other characters without a meaning of their own here, such as the
  /// micro sign.
  std::string_view letters() {
    const std::size_t begin = position_;
    const auto at_sign = [&] {
      const std::string_view rest = text_.substr(position_);
      return rest.starts_with("\u00b7") || rest.starts_with("\u22c5") ||
             rest.starts_with("\u207b") ||
             std::any_of(std::begin(raised_digits), std::end(raised_digits),
                         [&](std::string_view digit) { return rest.starts_with(digit); });
    };
    while (is_letter(peek()) && !at_sign()) ++position_;
    return text_.substr(begin, position_ - begin);
  }

  bool power_follows() const {
    const std::size_t digit = position_ + (peek() == '-' ? 1 : 0);
    return digit < text_.size() && is_digit(text_[digit]);
  }

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
    result.angle += by.angle * power;
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
