// SPDX-License-Identifier: BSD-3-Clause
// Converts values of a scene to values of the program, and back to TOML for the complete input.
#pragma once
#include "input/constants.hpp"
#include "input/input.hpp"
#include "input/scene_tree.hpp"
#include "input/text.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace meniscus::input_values {

std::string toml(bool value);
std::string toml(std::int64_t value);
std::string toml(Real value);
std::string toml(const std::string& value);
std::string toml(const Expression& value);
template <class T>
std::string toml(const std::vector<T>& values) {
  std::vector<std::string> items;
  for (const T& value : values) items.push_back(toml(value));
  return "[" + joined(items, ", ") + "]";
}

/// Throws "is an integer; allowed is `allowed`".
[[noreturn]] void refuse_kind(const scene_tree::Value& value, const std::string& allowed);

/// The value, if it has this type. Otherwise throws InputError (without a place).
template <class T>
T exactly(const scene_tree::Value& value, const std::string& allowed) {
  if (const T* found = std::get_if<T>(&value.data)) return *found;
  refuse_kind(value, allowed);
}

/// An integer of the range. A text is evaluated as a formula of constants.
std::int64_t integer(const scene_tree::Value& value, const Range& range, const Constants&);
/// "an integer, > 0".
std::string allowed_integer(const Range& range);

/// The dimension of a text with a unit or of a formula of constants; nothing for other values.
std::optional<Dimension> own_dimension(const scene_tree::Value& value, const Constants&);

/// Some number of the range, to continue with after a problem.
Real harmless(const Range& range);

/// Converts numbers of one dimension and range. The conversions throw InputError (without a place).
struct Number {
  const UnitSystem& units;
  Dimension dimension;
  Range range;
  const Constants& constants;
  bool in_plane;  ///< formulas know no z

  /// The unit that is written behind a number; empty for plain numbers.
  std::string unit() const;
  /// "a number in Pa or a text with a unit, > 0".
  std::string allowed() const { return allowed_or(""); }
  std::string allowed_or_formula(Variables) const;

  Real real(const scene_tree::Value& value) const;
  /// A text is read as a quantity ("2 mm") if possible, else as a formula.
  Expression expression(const scene_tree::Value& value, Variables) const;

 private:
  std::string allowed_or(const std::string& formula) const;
  const char* names_of(Variables) const;
  /// Throws if a formula has a variable that it does not know.
  void refuse_others(const Expression& formula, Variables) const;
  Real checked(Real value) const;
  /// The number of a text with or without a unit, or of a formula of constants.
  Real converted(const std::string& given) const;
  void refuse_radians(const std::string& text) const;
  /// Converts a formula that contains constants.
  Expression formula_of_constants(const std::string& given, Variables) const;
};

}  // namespace meniscus::input_values
