// SPDX-License-Identifier: BSD-3-Clause
// Units by name, and texts such as "72.8 mN/m" taken apart.
#pragma once
#include "meniscus/core/units.hpp"

#include <numbers>
#include <string>
#include <string_view>

namespace meniscus {

/// `factor` * 10^`tens` in SI. Powers of ten are kept apart so that they stay exact.
struct Unit {
  Dimension dimension;
  int tens = 0;
  Real factor = 1;
  int angle = 0;  ///< the power of rad and deg in it
};
/// In rad.
inline constexpr Real degree = std::numbers::pi / 180;

/// The unit called `symbol`, prefix included, e.g. "mPa". Throws InputError (without a place) that
/// names the units that look or sound like it.
Unit unit_called(std::string_view symbol);
/// Whether there is one.
bool is_unit(std::string_view symbol);

/// "a pressure (kg/(m s^2))": always in base units, so that two of them can be compared.
std::string name_of(Dimension);

/// digits * 10^exponent times a unit.
struct Quantity {
  std::string_view digits;  ///< points into the text
  int exponent = 0;
  Unit unit;
};

/// Throws InputError (without a place) if `text` is not a number with or without a unit.
Quantity read_quantity(std::string_view text);

}  // namespace meniscus
