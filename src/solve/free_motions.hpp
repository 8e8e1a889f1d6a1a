// SPDX-License-Identifier: BSD-3-Clause
// Rigid motions that cost no energy.
#pragma once
#include "solve/system.hpp"

namespace meniscus {

/// Rigid motions of bodies, or of all that touch each other together, along which no term has a
/// force at any state nearby and no place is held: the tangent is singular there, and so is a
/// preconditioner made for it. To first order about a motion, in coefficients.
template <int D>
class FreeMotions {
 public:
  /// None.
  FreeMotions() = default;
  /// At a motion, whose velocity counts for nothing. `scale`: of displacements that are small.
  FreeMotions(System<D>& system, const Motion& motion, Real scale);

  bool any() const { return !modes_.empty(); }
  /// Takes them out of forces or displacements.
  void remove_from(NodalVectors& w) const;

 private:
  void add(NodalVectors mode);

  std::vector<NodalVectors> modes_;  // orthonormal
};

}  // namespace meniscus
