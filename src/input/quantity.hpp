// SPDX-License-Identifier: BSD-3-Clause
// Units by name, and the parts of texts such as "72.8 mN/m".
#pragma once
#include "input/units.hpp"

#include <numbers>
#include <string>
#include <string_view>

namespace meniscus {

/// A unit: `factor` * 10^`tens` in SI. Powers of ten are kept apart so that they stay exact.
struct Unit {
  Dimension dimension;
  int tens = 0;
  Real factor = 1;
  int angle = 0;  ///< power of rad or deg in the unit
};
/// One degree in rad.
inline constexpr Real degree = std::numbers::pi / 180;

/// The unit called `symbol`, prefix included, e.g. "mPa". Throws InputError (without a place) that
/// names units with a similar spelling or sound.
Unit unit_called(std::string_view symbol);
/// True if unit_called() finds the symbol.
bool is_unit(std::string_view symbol);

/// The dimension as text, "a pressure (kg/(m s^2))", always in base units so that two can be
/// compared.
std::string name_of(Dimension);

/// A number and its unit: digits * 10^exponent * unit.
struct Quantity {
  std::string_view digits;  ///< points into the text
  int exponent = 0;
  Unit unit;
};

/// Throws InputError (without a place) if `text` is not a number with or without a unit.
Quantity read_quantity(std::string_view text);

}  // namespace meniscus
