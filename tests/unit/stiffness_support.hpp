// SPDX-License-Identifier: BSD-3-Clause
// Products with assembled tangents.
#pragma once
#include "numbers/dense.hpp"
#include "physics/assembled_force.hpp"
#include "support.hpp"

#include <Eigen/Dense>

namespace meniscus::test {

/// K w for displacements w; further unknowns are eliminated.
template <int D>
NodalVectors product(const StiffnessMatrix& K, const NodalVectors& w) {
  const auto n = static_cast<Eigen::Index>(w.size()) * D, more = K.unknowns() - n;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n + more), y = x;
  Eigen::MatrixXd further = Eigen::MatrixXd::Zero(more, more);
  for (std::size_t A = 0; A < w.size(); ++A)
    for (int i = 0; i < D; ++i) x[static_cast<Eigen::Index>(A) * D + i] = w[A][i];
  const auto multiply = [&] {
    y.setZero();
    for (Index j = 0; j < K.unknowns(); ++j)
      for (Index e = at(K.start(), j); e < at(K.start(), j + 1); ++e) {
        y[at(K.row(), e)] += at(K.value(), e) * x[j];
        if (j >= n && at(K.row(), e) >= n) further(at(K.row(), e) - n, j - n) = at(K.value(), e);
      }
  };
  multiply();
  if (more > 0) {
    x.tail(more) = further.partialPivLu().solve(-y.tail(more));
    multiply();
  }
  NodalVectors Kw(w.size(), Lanes::zero());
  for (std::size_t A = 0; A < w.size(); ++A)
    for (int i = 0; i < D; ++i) Kw[A].set(i, y[static_cast<Eigen::Index>(A) * D + i]);
  return Kw;
}

/// The assembled tangent of a force for a change of displacement, as add_tangent() gives it.
template <int D>
NodalVectors assembled_tangent(AssembledForce& force, const Motion& motion, const NodalVectors& w,
                               std::span<const Lanes> off = {}) {
  StiffnessMatrix K(static_cast<Index>(w.size()), D);
  force.announce(K);
  K.close();
  K.clear();
  force.add_stiffness(motion, off, K);
  K.complete();
  NodalVectors change = product<D>(K, w);
  for (NodalVector& f : change) f = -f;
  return change;
}

}  // namespace meniscus::test
