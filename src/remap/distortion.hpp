// SPDX-License-Identifier: BSD-3-Clause
// Distortion: how much the cells of a body differ from the cells of its reference configuration.
#pragma once
#include "body/body.hpp"

namespace meniscus {

/// Condition number of F at the particles: the ratio of the largest to the smallest stretch.
template <int D>
class Distortion {
 public:
  /// Throws SolveError if shape functions cannot be built.
  explicit Distortion(const Body<D>& body);

  /// The 99th percentile of the condition number over the particles. `u` has the displacement
  /// coefficients of the body. Infinite where F has no inverse.
  Real condition(const NodalVector* u) const;

 private:
  PointRows<D> rows_;
};

}  // namespace meniscus
