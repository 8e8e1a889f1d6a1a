// SPDX-License-Identifier: BSD-3-Clause
// Measures of the position and the shape of a body.
#pragma once
#include "body/body.hpp"
#include "input/expression.hpp"
#include "meniscus/physics/force_term.hpp"

#include <vector>

namespace meniscus {

/// Measures of the surface particles of a body: extents along the axes, aspect (largest over
/// smallest extent), p2 (amplitude of the second Legendre mode about the axis of the largest
/// reference extent, relative to the mean radius; in 2D of the mode cos 2 phi), radius (mean).
template <int D>
std::vector<MeasureSource> shape_measures(const Body<D>& body, const UnitSystem&);

/// An exact solution for state_error().
struct ExactSolution {
  std::vector<Expression> displacement, velocity;  ///< of reference position and time
  Real rate =
      0;  ///< weight of displacements beside velocities, 1/time; the frequency of an oscillation
};

/// "state_error": sqrt(sum V [rate^2 |u - u_ex|^2 + |v - v_ex|^2] / sum V [rate^2 |u_ex|^2 +
/// |v_ex|^2]) over the particles, with u and v at the particle positions (performance note 3).
template <int D>
MeasureSource state_error(const Body<D>& body, ExactSolution exact);

}  // namespace meniscus
