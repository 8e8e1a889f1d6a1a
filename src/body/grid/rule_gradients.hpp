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

/// Whether the rows of a rule are folded (PointRows): of a body of revolution.
template <int D>
bool is_folded(const CellRule<D>& rule) {
  return !rule.odd.empty();
}
template <int D>
bool is_folded(const PointRule<D>& rule) {
  return rule.rows.folded;
}
/// Numbers of a gradient per component: D, and the stretch of circles if the rows are folded.
template <class Rule>
int gradient_numbers(const Rule& rule, int dimension) {
  return is_folded(rule) ? dimension + 1 : dimension;
}

/// Sets G(a, q n + K) = N_A,K at the point q of a group, for A = particles[a] and n =
/// gradient_numbers(). For folded rows these are the gradients of one component; number D is N_A /
/// X_0 of component 0, and zero of others.
template <int D>
void shape_gradients(const CellRule<D>& rule, Index cell, std::span<const Index> particles,
                     int component, Eigen::MatrixXd& G) {
  const int n = gradient_numbers(rule, D);
  const bool odd = n > D && component == 0;
  G.setZero(static_cast<Eigen::Index>(particles.size()), rule.points_per_group() * n);
  const Lanes* xi = rule.point.data() + static_cast<std::size_t>(cell) * D;
  for (Offset e = at(rule.start, cell); e < at(rule.start, cell + 1); ++e) {
    const Index a = detail::position_in(particles, at(rule.particle, e));
    for (int K = 0; K < (odd ? D + 1 : D); ++K) {
      const Lanes& moments = odd ? at(rule.odd, e * (D + 1) + K) : at(rule.coefficient, e * D + K);
      for (Index q = 0; q < rule.points_per_group(); ++q) {
        Real& g = G(a, q * n + K);
        g = moments[0];
        for (int M = 0; M < D; ++M) g += moments[M + 1] * xi[M][static_cast<int>(q)];
      }
    }
  }
}
template <int D>
void shape_gradients(const PointRule<D>& rule, Index group, std::span<const Index> particles,
                     int component, Eigen::MatrixXd& G) {
  const PointRows<D>& rows = rule.rows;
  const int n = gradient_numbers(rule, D);
  const bool odd = n > D && component == 0;
  G.setZero(static_cast<Eigen::Index>(particles.size()), rule.points_per_group() * n);
  const Index first = group * rule.per_group;
  for (Index q = 0; q < rule.per_group && first + q < rows.size(); ++q)
    for (Offset e = at(rows.start, first + q); e < at(rows.start, first + q + 1); ++e) {
      const Index a = detail::position_in(particles, at(rows.particle, e));
      for (int K = 0; K < D; ++K)
        G(a, q * n + K) = at(odd ? rows.odd_gradient : rows.gradient, e * D + K);
      if (odd) G(a, q * n + D) = at(rows.odd_value, e) / at(rows.radius, first + q);
    }
}

}  // namespace meniscus
