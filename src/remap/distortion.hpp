// SPDX-License-Identifier: BSD-3-Clause
// How far the cells of a body are from those of its reference.
#pragma once
#include "body/body.hpp"

namespace meniscus {

/// Condition number of F, the ratio of the largest and the least stretch, at the particles.
template <int D>
class Distortion {
 public:
  /// Throws SolveError if shape functions cannot be built.
  explicit Distortion(const Body<D>& body);

  /// What 99 of 100 particles stay below; `u` is that of the body. Infinite where F has no inverse.
  Real condition(const NodalVector* u) const;

 private:
  PointRows<D> rows_;
};

}  // namespace meniscus
