// SPDX-License-Identifier: BSD-3-Clause
// Rigid motions of bodies that cost no energy.
#pragma once
#include "solve/system.hpp"

namespace meniscus {

/// Rigid motions of bodies, or of groups of touching bodies, along which no term exerts a force in
/// nearby states (translations: forces balance each other) and no place is held. The tangent and
/// its preconditioner are singular for these motions. They are coefficients, to first order about a
/// motion.
template <int D>
class FreeMotions {
 public:
  /// No motions.
  FreeMotions() = default;
  /// Finds the free motions at `motion`, whose velocity is ignored, for the terms for which
  /// wanted(term). `scale` is the size of small trial displacements.
  FreeMotions(System<D>& system, const Motion& motion, Real scale,
              typename System<D>::Wanted wanted = System<D>::every);

  bool any() const { return !modes_.empty(); }
  /// Orthonormal.
  const std::vector<NodalVectors>& modes() const { return modes_; }
  /// Removes them from forces or displacements.
  void remove_from(NodalVectors& w) const;

 private:
  /// Adds a mode, unless it is a combination of the present modes.
  void add(NodalVectors mode);

  std::vector<NodalVectors> modes_;
};

}  // namespace meniscus
