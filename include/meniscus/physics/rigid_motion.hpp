// SPDX-License-Identifier: BSD-3-Clause
// Prescribed translation of a rigid partner.
#pragma once
#include "meniscus/core/expression.hpp"

#include <vector>

namespace meniscus {

/// A rigid partner at time t is where it was made, moved by displacement(t): a point x of space is
/// x - displacement(t) in its frame. The outside world that moves it does the power F.v, with F the
/// force of the partner on the bodies and v its velocity.
template <int D>
class RigidMotion {
 public:
  /// At rest.
  RigidMotion() = default;
  /// D formulas of the time t; x, y and z are zero in them.
  explicit RigidMotion(std::vector<Expression> displacement);

  /// Whether the displacement depends on the time.
  bool moves() const;
  Vec<D> displacement(Real t) const;
  /// Central difference of fourth order over t - 2 step ... t + 2 step; exact for polynomials of
  /// degree four. The time step is a good `step`.
  Vec<D> velocity(Real t, Real step) const;

 private:
  std::vector<Expression> displacement_;
};

}  // namespace meniscus
