// SPDX-License-Identifier: BSD-3-Clause
// Named numbers of a scene, the table [constants], and the values of formulas with them.
#include "input/constants.hpp"

#include "input/input.hpp"
#include "input/names.hpp"
#include "input/quantity.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace meniscus {
namespace {

/// The expression of a formula. Only the constants that occur in it are passed, since there may be
/// a thousand of them. If the formula is wrong, all are passed, for the suggestion in the message.
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
  for (const NamePlace& place : name_places(formula))
    names.emplace_back(formula.substr(place.begin, place.end - place.begin));
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
  if (plain_number_in(formula)) return add(name, value, std::nullopt);
  std::array<Real, 4> values{};
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    at(values, i) = single_number(formula, at(numbers_, i));
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    at(numbers_, i).emplace_back(name, at(values, i));
}

bool Constants::in(std::string_view formula) const {
  if (empty()) return false;
  if (functions.in(formula)) return true;
  const std::vector<std::string> names = names_in(formula);
  return broken_in(formula) || std::any_of(numbers().begin(), numbers().end(), [&](const auto& c) {
           return std::find(names.begin(), names.end(), c.first) != names.end();
         });
}

std::string Constants::hint(std::string_view formula) const {
  for (const std::string& name : names_in(formula)) {
    const bool known = is_word_of_formulas(name) || in(name);
    const std::string meant = known ? "" : did_you_mean(name, functions.names());
    if (!meant.empty()) return meant;
  }
  return "";
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

/// True if the dimension of the formula is unknown because it uses a plain number. The NaN in
/// numbers_[1 .. 3] are not sufficient to detect this: a comparison with NaN gives a number.
bool Constants::plain_number_in(std::string_view formula) const {
  const std::vector<std::string> names = names_in(formula);
  return std::any_of(numbers_[1].begin(), numbers_[1].end(), [&](const auto& c) {
    return std::isnan(c.second) && std::find(names.begin(), names.end(), c.first) != names.end();
  });
}

std::optional<Dimension> Constants::dimension_of(const std::string& formula) const {
  if (plain_number_in(formula)) return std::nullopt;
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
