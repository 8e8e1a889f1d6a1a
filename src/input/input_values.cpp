// SPDX-License-Identifier: BSD-3-Clause
// Converts values of a scene to values of the program, and back to TOML for the complete input.
#include "input/input_values.hpp"

#include "input/quantity.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace meniscus::input_values {

using scene_tree::Value;

namespace {

/// The value, if it is a number without quotes.
std::optional<Real> plain_number(const Value& value) {
  if (const Real* real = std::get_if<Real>(&value.data)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    return static_cast<Real>(*integer);
  return std::nullopt;
}

}  // namespace

std::string toml(bool value) {
  return value ? "true" : "false";
}
std::string toml(std::int64_t value) {
  return fmt::format("{}", value);
}
std::string toml(Real value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}
std::string toml(const std::string& value) {
  return scene_tree::quoted(value);
}
std::string toml(const Expression& value) {
  return value.constant() ? toml(value({0, 0, 0})) : toml(value.text());
}

void refuse_kind(const Value& value, const std::string& allowed) {
  throw InputError(fmt::format("is {}; allowed is {}", scene_tree::kind(value), allowed));
}

std::string allowed_integer(const Range& range) {
  const std::string text = range.text();
  return text == "any" ? "an integer" : "an integer " + text;
}

namespace {

std::int64_t integer_of_constants(const std::string& given, const Range& range,
                                  const Constants& constants) {
  const std::string formula = constants.functions.expanded(given);
  if (constants.broken_in(formula)) return static_cast<std::int64_t>(harmless(range));
  const Real value = constants.value(formula, dimension::none);
  constexpr Real largest = 9007199254740992;  // larger integers may not be exact as Real
  if (std::abs(value) <= largest && value == std::round(value))
    return static_cast<std::int64_t>(value);
  throw InputError(
      fmt::format("formula '{}' is {}; allowed is {}", formula, value, allowed_integer(range)));
}

}  // namespace

std::int64_t integer(const Value& value, const Range& range, const Constants& constants) {
  const auto* text = std::get_if<std::string>(&value.data);
  const auto found = text != nullptr && constants.in(*text)
                         ? integer_of_constants(*text, range, constants)
                         : exactly<std::int64_t>(value, allowed_integer(range));
  if (range.contains(static_cast<Real>(found))) return found;
  throw InputError(range.refusal(static_cast<Real>(found)));
}

std::optional<Dimension> own_dimension(const Value& value, const Constants& constants) {
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr) return std::nullopt;
  try {
    if (constants.in(*text)) {
      if (constants.broken_in(*text)) return std::nullopt;
      return constants.dimension_of(constants.functions.expanded(*text));
    }
    const Unit unit = read_quantity(*text).unit;
    if (unit.dimension != dimension::none) return unit.dimension;
    return unit.angle == 0 ? std::nullopt : std::optional(dimension::degrees);
  } catch (const InputError&) {
    return std::nullopt;  // not a number: the reader of the key refuses it
  }
}

Real harmless(const Range& range) {
  for (const Real candidate : {1.0, 0.0, range.low, range.high, range.low / 2 + range.high / 2})
    if (range.contains(candidate)) return candidate;
  return 0;
}

const char* Number::names_of(Variables variables) const {
  switch (variables) {
    case Variables::place:
      return in_plane ? "x, y" : "x, y, z";
    case Variables::time:
      return "t";
    case Variables::place_and_time:
      break;
  }
  return in_plane ? "x, y, t" : "x, y, z, t";
}

void Number::refuse_others(const Expression& formula, Variables variables) const {
  if (variables == Variables::place && formula.depends_on_time())
    throw InputError(fmt::format("formula '{}': it does not know the time t", formula.text()));
  if (variables == Variables::time && formula.depends_on_place())
    throw InputError(fmt::format("formula '{}': it knows no place x, y, z", formula.text()));
  if (in_plane && formula.depends_on_axis(2))
    throw InputError(
        fmt::format("formula '{}': a 2D scene (dimension = 2) has no z", formula.text()));
}

std::string Number::unit() const {
  return dimension == dimension::none ? "" : units.symbol(dimension);
}

std::string Number::allowed_or_formula(Variables variables) const {
  return allowed_or(fmt::format(" or a formula of {}", names_of(variables)));
}

std::string Number::allowed_or(const std::string& formula) const {
  std::string text = "a number";
  if (!unit().empty()) text += " in " + unit() + " or a text with a unit";
  text += formula;
  if (!constants.empty()) text += " or a formula of [constants]";
  return range.text() == "any" ? text : text + ", " + range.text();
}

Real Number::checked(Real value) const {
  if (range.contains(value)) return value;
  throw InputError(range.refusal(value, unit()));
}

Real Number::real(const Value& value) const {
  if (const auto number = plain_number(value)) return checked(*number);
  if (const auto* text = std::get_if<std::string>(&value.data)) return checked(converted(*text));
  refuse_kind(value, allowed());
}

void Number::refuse_radians(const std::string& text) const {
  if (dimension == dimension::degrees && constants.angle_in(text))
    throw InputError(fmt::format(
        "formula '{}' has a constant in deg or rad, whose number is that of radians, expected {}; "
        "give the constant as a number of degrees, without a unit",
        text, name_of(dimension)));
}

/// Begins a message with the formula as it was given, if functions were expanded in it.
std::string origin(const std::string& given, const std::string& read) {
  return given == read ? "" : fmt::format("'{}' by [functions]: ", given);
}

Real Number::converted(const std::string& given) const {
  std::string text = given;
  try {
    if (constants.in(given) && !constants.broken_in(given))
      text = constants.functions.expanded(given);
    if (constants.broken_in(text)) return harmless(range);
    refuse_radians(text);
    if (constants.in(given)) return constants.value(text, dimension);
    return units.quantity(text, dimension);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}{}{}; allowed is {}", origin(given, text), error.what(),
                                 constants.hint(given), allowed()));
  }
}

Expression Number::expression(const Value& value, Variables variables) const {
  if (const auto number = plain_number(value)) return checked(*number);
  const auto* text = std::get_if<std::string>(&value.data);
  if (text == nullptr) refuse_kind(value, allowed_or_formula(variables));
  if (constants.in(*text)) return formula_of_constants(*text, variables);
  std::optional<Real> quantity;
  std::string not_quantity;
  try {
    quantity = units.quantity(*text, dimension);
  } catch (const InputError& error) {
    not_quantity = error.what();
  }
  if (quantity) return checked(*quantity);
  std::optional<Expression> formula;
  try {
    formula.emplace(*text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("neither a quantity ({}) nor a formula ({}{}); allowed is {}",
                                 not_quantity, error.what(), constants.hint(*text),
                                 allowed_or_formula(variables)));
  }
  refuse_others(*formula, variables);
  return formula->constant() ? checked((*formula)({0, 0, 0})) : *std::move(formula);
}

Expression Number::formula_of_constants(const std::string& given, Variables variables) const {
  if (constants.broken_in(given)) return harmless(range);
  std::string text = given;
  std::optional<Real> number;
  try {
    text = constants.functions.expanded(given);
    if (constants.broken_in(text)) return harmless(range);
    refuse_radians(text);
    Expression formula(text, constants.numbers());
    refuse_others(formula, variables);
    if (!formula.constant()) return formula;
    number = constants.value(text, dimension);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}{}{}; allowed is {}", origin(given, text), error.what(),
                                 constants.hint(given), allowed_or_formula(variables)));
  }
  return checked(*number);
}

}  // namespace meniscus::input_values
