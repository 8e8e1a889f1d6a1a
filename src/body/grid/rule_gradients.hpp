// SPDX-License-Identifier: BSD-3-Clause
// Gradients of shape functions at the quadrature points of a group as a dense matrix, for assembled
// tangents.
#pragma once
#include "body/grid/stress_rules.hpp"

#include <algorithm>
#include <vector>

namespace meniscus {

/// The particles that contribute to a group, in ascending order.
template <int D>
std::vector<Index> particles_of(const CellRule<D>& rule, Index cell) {
  std::vector<Index> particles(rule.particle.begin() + at(rule.start, cell),
                               rule.particle.begin() + at(rule.start, cell + 1));
  std::sort(particles.begin(), particles.end());
  return particles;
}
template <int D>
std::vector<Index> particles_of(const PointRule<D>& rule, Index group) {
  const Index first = group * rule.per_group,
              next = std::min(first + rule.per_group, rule.rows.size());
  std::vector<Index> particles(rule.rows.particle.begin() + at(rule.rows.start, first),
                               rule.rows.particle.begin() + at(rule.rows.start, next));
  std::sort(particles.begin(), particles.end());
  particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  return particles;
}

namespace detail {

inline Index position_in(std::span<const Index> particles, Index A) {
  return static_cast<Index>(std::lower_bound(particles.begin(), particles.end(), A) -
                            particles.begin());
}

}  // namespace detail

/// Sets G(a, q D + K) = N_A,K at the point q of a group, for A = particles[a].
template <int D>
void shape_gradients(const CellRule<D>& rule, Index cell, std::span<const Index> particles,
                     Eigen::MatrixXd& G) {
  G.setZero(static_cast<Eigen::Index>(particles.size()), rule.points_per_group() * D);
  const Lanes* xi = rule.point.data() + static_cast<std::size_t>(cell) * D;
  for (Offset e = at(rule.start, cell); e < at(rule.start, cell + 1); ++e) {
    const Index a = detail::position_in(particles, at(rule.particle, e));
    for (int K = 0; K < D; ++K) {
      const Lanes& moments = at(rule.coefficient, e * D + K);
      for (Index q = 0; q < rule.points_per_group(); ++q) {
        Real& g = G(a, q * D + K);
        g = moments[0];
        for (int M = 0; M < D; ++M) g += moments[M + 1] * xi[M][static_cast<int>(q)];
      }
    }
  }
}
template <int D>
void shape_gradients(const PointRule<D>& rule, Index group, std::span<const Index> particles,
                     Eigen::MatrixXd& G) {
  G.setZero(static_cast<Eigen::Index>(particles.size()), rule.points_per_group() * D);
  const Index first = group * rule.per_group;
  for (Index q = 0; q < rule.per_group && first + q < rule.rows.size(); ++q)
    for (Offset e = at(rule.rows.start, first + q); e < at(rule.rows.start, first + q + 1); ++e) {
      const Index a = detail::position_in(particles, at(rule.rows.particle, e));
      for (int K = 0; K < D; ++K) G(a, q * D + K) = at(rule.rows.gradient, e * D + K);
    }
}

}  // namespace meniscus
