// SPDX-License-Identifier: BSD-3-Clause
// Condition number of F at the particles of a body.
#include "remap/distortion.hpp"

#include "kernel/row_sums.hpp"
#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace meniscus {

template <int D>
Distortion<D>::Distortion(const Body<D>& body)
    : rows_(
          build_point_rows<D>(body.particles, body.particles.X(), {.gradient = true}, body.name)) {}

template <int D>
Real Distortion<D>::condition(const NodalVector* u) const {
  std::vector<Real> all(static_cast<std::size_t>(rows_.size()));
  parallel_for(rows_.size(), [&](Index A) {
    const std::array<Lanes, D> gradient = gradient_at(rows_, A, u);
    Mat<D> F = Mat<D>::Identity();
    for (int i = 0; i < D; ++i)
      for (int K = 0; K < D; ++K) F(i, K) += at(gradient, K)[i];
    const Vec<D> square = symmetric_eigenvalues<D>(F.transpose() * F);
    at(all, A) = square.minCoeff() > 0 ? std::sqrt(square.maxCoeff() / square.minCoeff())
                                       : std::numeric_limits<Real>::infinity();
  });
  const auto rank =
      all.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<Real>(all.size() - 1));
  std::nth_element(all.begin(), rank, all.end());
  return *rank;
}

template class Distortion<2>;
template class Distortion<3>;

}  // namespace meniscus
