// SPDX-License-Identifier: BSD-3-Clause
// Named numbers of a scene, the table [constants], and what formulas of them are.
#include "constants.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/core/input.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "quantity.hpp"

namespace meniscus {
namespace {

bool is_digit_or_point(char c) {
  return (c >= '0' && c <= '9') || c == '.';
}
bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool continues_name(char c) {
  return begins_name(c) || (c >= '0' && c <= '9');
}

/// Behind the number that begins at `i`.
std::size_t end_of_number(std::string_view text, std::size_t i) {
  while (i < text.size() && is_digit_or_point(text[i])) ++i;
  if (i == text.size() || (text[i] != 'e' && text[i] != 'E')) return i;
  std::size_t exponent = i + 1;
  if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
  if (exponent == text.size() || !is_digit_or_point(text[exponent])) return i;
  while (exponent < text.size() && is_digit_or_point(text[exponent])) ++exponent;
  return exponent;
}

/// Formulas are made with the constants that occur in them, as there may be a thousand; with all,
/// if one is to be said that was meant.
Expression expression_of(const std::string& formula, const NamedNumbers& constants) {
  const std::vector<std::string> names = names_in(formula);
  NamedNumbers used;
  std::copy_if(constants.begin(), constants.end(), std::back_inserter(used), [&](const auto& c) {
    return std::find(names.begin(), names.end(), c.first) != names.end();
  });
  try {
    return Expression(formula, used);
  } catch (const InputError&) {
    return Expression(formula, constants);
  }
}

Real single_number(const std::string& formula, const NamedNumbers& constants) {
  const Expression expression = expression_of(formula, constants);
  if (!expression.constant())
    throw InputError(fmt::format("formula '{}': a single number knows no x, y, z, t", formula));
  return expression({0, 0, 0});
}

bool any_in(std::string_view formula, const std::set<std::string>& set) {
  const std::vector<std::string> names = names_in(formula);
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return set.count(name) != 0; });
}

}  // namespace

std::vector<std::string> names_in(std::string_view formula) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < formula.size();) {
    if (is_digit_or_point(formula[i])) {
      i = end_of_number(formula, i);
    } else if (begins_name(formula[i])) {
      const std::size_t begin = i;
      while (i < formula.size() && continues_name(formula[i])) ++i;
      names.emplace_back(formula.substr(begin, i - begin));
    } else {
      ++i;
    }
  }
  return names;
}

void Constants::add(const std::string& name, Real value, std::optional<Dimension> dimension) {
  const Dimension d = dimension.value_or(Dimension{});
  const int powers[] = {0, d.length, d.time, d.mass};
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    at(numbers_, i)
        .emplace_back(name, dimension || i == 0 ? std::ldexp(value, at(powers, i))
                                                : std::numeric_limits<Real>::quiet_NaN());
}

void Constants::add_angle(const std::string& name, Real radians) {
  add(name, radians);
  angles_.insert(name);
}

void Constants::add_formula(const std::string& name, const std::string& formula) {
  const Real value = single_number(formula, numbers());
  if (!std::isfinite(value)) throw InputError(range::any.refusal(value));
  if (!in(formula)) return add(name, value);
  if (angle_in(formula)) angles_.insert(name);
  std::array<Real, 4> values{};
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    at(values, i) = single_number(formula, at(numbers_, i));
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    at(numbers_, i).emplace_back(name, at(values, i));
}

bool Constants::in(std::string_view formula) const {
  if (empty()) return false;
  const std::vector<std::string> names = names_in(formula);
  return broken_in(formula) || std::any_of(numbers().begin(), numbers().end(), [&](const auto& c) {
           return std::find(names.begin(), names.end(), c.first) != names.end();
         });
}

bool Constants::broken_in(std::string_view formula) const {
  return any_in(formula, broken_);
}

bool Constants::angle_in(std::string_view formula) const {
  return any_in(formula, angles_);
}

Real Constants::value(const std::string& formula, Dimension expected) const {
  const Real value = single_number(formula, numbers());
  const auto found = dimension_of(formula);
  if (found && *found != dimension::none && *found != expected)
    throw InputError(fmt::format("formula '{}' is {}, expected {}", formula, name_of(*found),
                                 name_of(expected)));
  return value;
}

std::optional<Dimension> Constants::dimension_of(const std::string& formula) const {
  const Real value = single_number(formula, numbers());
  std::array<int, 3> powers{};
  for (std::size_t i = 0; i < powers.size(); ++i) {
    const Real power = std::log2(single_number(formula, at(numbers_, i + 1)) / value);
    if (!(std::abs(power - std::round(power)) < 1e-9)) return std::nullopt;
    at(powers, i) = static_cast<int>(std::round(power));
  }
  return Dimension{powers[0], powers[1], powers[2]};
}

}  // namespace meniscus
