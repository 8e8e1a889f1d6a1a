// SPDX-License-Identifier: BSD-3-Clause
// Prescribed translation of a rigid partner.
#pragma once
#include "input/expression.hpp"

#include <vector>

namespace meniscus {

/// Motion of a rigid partner by displacement(t) from its initial position. A point x has the
/// position x - displacement(t) in the frame of the partner. The power supplied from outside is
/// F.v, with the force F of the partner on the bodies and its velocity v.
template <int D>
class RigidMotion {
 public:
  /// A partner at rest.
  RigidMotion() = default;
  /// `displacement`: D formulas of the time t; x, y and z are zero in them.
  explicit RigidMotion(std::vector<Expression> displacement);

  /// True if the displacement depends on time.
  bool moves() const;
  Vec<D> displacement(Real t) const;
  /// The velocity, by a central difference of fourth order over t - 2 step ... t + 2 step, which is
  /// exact for polynomials of degree four. The time step is a good `step`.
  Vec<D> velocity(Real t, Real step) const;

 private:
  std::vector<Expression> displacement_;
};

}  // namespace meniscus
