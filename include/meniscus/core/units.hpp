// SPDX-License-Identifier: BSD-3-Clause
// Physical dimensions and the unit system of a scene.
#pragma once
#include <string>
#include <string_view>

#include "meniscus/core/types.hpp"

namespace meniscus {

/// Exponents of length, time and mass.
struct Dimension {
  int length = 0, time = 0, mass = 0;
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension none{}, length{1, 0, 0}, area{2, 0, 0}, volume{3, 0, 0}, time{0, 1, 0},
    rate{0, -1, 0}, velocity{1, -1, 0}, acceleration{1, -2, 0}, mass{0, 0, 1}, density{-3, 0, 1},
    pressure{-1, -2, 1}, viscosity{-1, -1, 1}, tension{0, -2, 1}, force{1, -2, 1},
    energy{2, -2, 1}, power{2, -3, 1}, momentum{1, -1, 1}, angular_momentum{2, -1, 1};
}

/// The system in which plain numbers of a scene, all results, and all sums inside the program are
/// written: "SI" (m, s, kg) or a length-time-mass triple such as "nm-ps-ag".
class UnitSystem {
 public:
  /// Throws InputError (without a place) that lists the known units.
  explicit UnitSystem(std::string_view name = "SI");

  /// The number of `text`, e.g. "72.8 mN/m" or "2.2 GPa", in this system.
  /// Throws InputError (without a place) on an unknown unit or one of another dimension.
  Real quantity(std::string_view text, Dimension expected) const;

  /// How a dimension is written in this system: "Pa" or "kg/(m s^2)"; "1" for none.
  std::string symbol(Dimension dimension) const;

  const std::string& name() const { return name_; }
  /// One unit of `dimension` of this system in SI.
  Real in_si(Dimension dimension) const;

 private:
  std::string name_, length_, time_, mass_;
  Real length_si_, time_si_, mass_si_;
};

}  // namespace meniscus
