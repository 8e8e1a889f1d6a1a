// SPDX-License-Identifier: BSD-3-Clause
// Physical dimensions and the unit system of a scene.
#pragma once
#include "numbers/types.hpp"

#include <array>
#include <string>
#include <string_view>

namespace meniscus {

/// Exponents of length, time and mass. `degrees` marks an angle whose number is in degrees. `depth`
/// is the exponent of a length that a sum over bodies in the plane lacks, since it is per unit of
/// depth; a UnitSystem of whole bodies ignores it.
struct Dimension {
  int length = 0, time = 0, mass = 0;
  bool degrees = false;
  int depth = 0;
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension none{}, length{1, 0, 0}, area{2, 0, 0}, volume{3, 0, 0}, time{0, 1, 0},
    rate{0, -1, 0}, velocity{1, -1, 0}, acceleration{1, -2, 0}, mass{0, 0, 1}, density{-3, 0, 1},
    pressure{-1, -2, 1}, viscosity{-1, -1, 1}, tension{0, -2, 1}, force{1, -2, 1}, energy{2, -2, 1},
    power{2, -3, 1}, momentum{1, -1, 1}, angular_momentum{2, -1, 1}, degrees{0, 0, 0, true};
}

/// The dimension of a sum over bodies (mass, force, energy): in 2D it is per unit of depth.
constexpr Dimension of_sum(Dimension d, int space_dimension) {
  if (space_dimension == 2) --d.depth;
  return d;
}

/// The units that texts may use: "m, s, ... (prefixes ...), min, ...". kT is at 25 degrees Celsius.
std::string unit_list();

/// The unit system of plain numbers of a scene, of all results and of all sums inside the program:
/// "SI" (m, s, kg) or a length-time-mass triple such as "nm-ps-ag".
///
/// unit_list() lists the units. They are combined by spaces, *, a raised dot, /, brackets and
/// integer powers: "kg/(m s^2)", "g/cm3", "mPa s". A unit after a divisor needs brackets: "Pa/m s"
/// is refused.
class UnitSystem {
 public:
  /// Throws InputError (without a place) that names the known units.
  explicit UnitSystem(std::string_view name = "SI");
  /// From now on sums over bodies in the plane are those of whole bodies, of revolution.
  void take_whole_bodies() { whole_ = true; }
  bool of_whole_bodies() const { return whole_; }

  /// The number of `text`, e.g. "72.8 mN/m" or "2.2 GPa", in this system. Powers of ten are moved
  /// into the decimal exponent, so "72.8 mN/m" is exactly the double 0.0728 in SI. Angles ("2 rad",
  /// "115 deg") become radians, or degrees if degrees are expected. Throws InputError (without a
  /// place) on an unknown unit or a unit of another dimension.
  Real quantity(std::string_view text, Dimension expected) const;

  /// The unit of a dimension in this system: "Pa" or "ag/(nm ps^2)"; "1" for numbers without unit.
  std::string symbol(Dimension dimension) const;

  /// The dimension with its depth as lengths; without depth, for whole bodies.
  Dimension settled(Dimension dimension) const {
    if (!whole_) dimension.length += dimension.depth;
    dimension.depth = 0;
    return dimension;
  }

  const std::string& name() const { return name_; }
  /// The size in SI of one unit of `dimension` of this system.
  Real in_si(Dimension dimension) const;

 private:
  /// A base unit: `factor` * 10^`tens` in SI.
  struct Base {
    std::string symbol;
    int tens = 0;
    Real factor = 1;
  };
  int tens(Dimension dimension) const;
  Real factor(Dimension dimension) const;

  std::string name_;
  bool whole_ = false;
  Base length_, time_, mass_;
};

}  // namespace meniscus
