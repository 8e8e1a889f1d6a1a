// SPDX-License-Identifier: BSD-3-Clause
// Unknown fields beside the displacement: a concentration, a director, a temperature.
#pragma once
#include "input/units.hpp"
#include "parallel/aligned.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// The equation of motion of the values x of a field under the forces f = -dE/dx.
enum class Evolution {
  inertial,      ///< c x'' = f
  relaxational,  ///< c x' = f
  carried        ///< c x' = f, and the material carries x by a CarriedField
};

struct FieldSpec {
  std::string name;    ///< e.g. "director"
  int components = 1;  ///< at most four
  Dimension dimension = {};
  Evolution evolution = Evolution::relaxational;
  Real scale = 1;  ///< typical change of the values: trial changes are small against it

  friend bool operator==(const FieldSpec&, const FieldSpec&) = default;
};

/// A field on the particles of all bodies. It exists only if a term requested it.
struct Unknown {
  FieldSpec spec;
  std::vector<Real> capacity;  ///< c, [particle]
  NodalVectors x, rate, f;     ///< values, x', forces
};

}  // namespace meniscus
