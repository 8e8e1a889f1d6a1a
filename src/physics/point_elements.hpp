// SPDX-License-Identifier: BSD-3-Clause
// The tangent of forces on points of a body as elements of a matrix.
#pragma once
#include "body/grid/rule_gradients.hpp"
#include "physics/stiffness_matrix.hpp"

namespace meniscus {

/// Minus the derivatives of the forces on the positions x and the deformation gradients F at the
/// points of a group. Both are given as D + 1 numbers per component: x_i, F_i1, ..., F_iD.
template <int D>
struct PointModuli {
  /// The derivative of the force on number a of component i, with number b of component j.
  Lanes& operator()(int i, int a, int j, int b) {
    return at(of, ((i * (D + 1) + a) * D + j) * (D + 1) + b);
  }
  std::array<Lanes, static_cast<std::size_t>(D* D*(D + 1) * (D + 1))> of{};
};

/// Elements of the groups of a point rule whose rows have values and gradients.
template <int D>
class PointElements {
 public:
  /// Announces an element for each group. `first`: number of the first particle of the body.
  void announce(const PointRule<D>& rule, Index first, StiffnessMatrix& K) {
    std::vector<Index> particles;
    for (Index g = 0; g < rule.groups(); ++g) {
      particles = particles_of(rule, g);
      for (Index& A : particles) A += first;
      const Index element = K.announce(particles);
      if (g == 0) first_element_ = element;
    }
  }

  /// Adds the elements of all groups, or of those in a list. make(g, moduli) adds to the moduli,
  /// which are zero before.
  template <class Make>
  void add(const PointRule<D>& rule, StiffnessMatrix& K, Make&& make) const {
    K.add(first_element_, rule.groups(),
          [&](Index g, StiffnessMatrix::Element& element) { set(rule, g, make, element); });
  }
  template <class Make>
  void add(const PointRule<D>& rule, std::span<const Index> groups, StiffnessMatrix& K,
           Make&& make) const {
    K.add(first_element_, groups,
          [&](Index g, StiffnessMatrix::Element& element) { set(rule, g, make, element); });
  }

 private:
  template <class Make>
  static void set(const PointRule<D>& rule, Index g, Make&& make,
                  StiffnessMatrix::Element& element) {
    thread_local std::array<Eigen::MatrixXd, D> N;
    thread_local Eigen::MatrixXd NC, C;
    const std::vector<Index> particles = particles_of(rule, g);
    const bool folded = is_folded(rule);
    for (int i = 0; i < (folded ? D : 1); ++i) shapes(rule, g, particles, i, at(N, i));
    const auto shapes_of = [&](int i) -> const Eigen::MatrixXd& { return at(N, folded ? i : 0); };
    PointModuli<D> moduli;
    moduli.of.fill(Lanes::zero());
    make(g, moduli);
    const auto m = static_cast<Eigen::Index>(particles.size());
    auto block = element.resize(m * D);
    for (int i = 0; i < D; ++i)
      for (int j = i; j < D; ++j) {
        C.setZero(N[0].cols(), N[0].cols());
        for (int a = 0; a <= D; ++a)
          for (int b = 0; b <= D; ++b)
            for (int q = 0; q < rule.per_group; ++q)
              C(q * (D + 1) + a, q * (D + 1) + b) = moduli(i, a, j, b)[q];
        NC.noalias() = shapes_of(i) * C;
        block.block(i * m, j * m, m, m).noalias() = NC * shapes_of(j).transpose();
      }
  }
  /// Sets N(a, q (D + 1)) = N_A at the point q of a group, and its gradient in the next columns, of
  /// one component if the rows are folded.
  static void shapes(const PointRule<D>& rule, Index group, std::span<const Index> particles,
                     int component, Eigen::MatrixXd& N) {
    thread_local Eigen::MatrixXd G;
    shape_gradients(rule, group, particles, component, G);
    const int n = gradient_numbers(rule, D);
    const auto& value = rule.rows.folded && component == 0 ? rule.rows.odd_value : rule.rows.value;
    N.setZero(G.rows(), rule.per_group * (D + 1));
    for (Index q = 0; q < rule.per_group; ++q) {
      N.middleCols(q * (D + 1) + 1, D) = G.middleCols(q * n, D);
      const Index point = group * rule.per_group + q;
      if (point >= rule.rows.size()) continue;
      for (Offset e = at(rule.rows.start, point); e < at(rule.rows.start, point + 1); ++e)
        N(detail::position_in(particles, at(rule.rows.particle, e)), q * (D + 1)) = at(value, e);
    }
  }

  Index first_element_ = -1;
};

/// Elements of groups of points whose rows have values: positions, or mean displacements.
template <int D>
class MeanElements {
 public:
  /// Announces an element for each group of points, each in ascending order.
  void announce(const PointRows<D>& rows, std::vector<std::vector<Index>> groups, Index first,
                StiffnessMatrix& K) {
    groups_ = std::move(groups);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      std::vector<Index> particles = particles_of(rows, g);
      for (Index& A : particles) A += first;
      const Index element = K.announce(particles);
      if (g == 0) first_element_ = element;
    }
  }

  std::span<const Index> points(Index group) const { return at(groups_, group); }
  /// Adds the elements of all groups. make(g, M) adds to M, which is zero before: minus the
  /// derivatives of the force on point q of the group, M(i Q + q, j Q + r), where Q is the number
  /// of its points.
  template <class Make>
  void add(const PointRows<D>& rows, StiffnessMatrix& K, Make&& make) const {
    K.add(first_element_, static_cast<Index>(groups_.size()),
          [&](Index g, StiffnessMatrix::Element& element) {
            thread_local std::array<Eigen::MatrixXd, D> N;
            thread_local Eigen::MatrixXd NM, M;
            const std::vector<Index>& points = at(groups_, g);
            const std::vector<Index> particles = particles_of(rows, static_cast<std::size_t>(g));
            const auto m = static_cast<Eigen::Index>(particles.size()),
                       Q = static_cast<Eigen::Index>(points.size());
            for (int i = 0; i < (rows.folded ? D : 1); ++i) {
              const auto& value = rows.folded && i == 0 ? rows.odd_value : rows.value;
              at(N, i).setZero(m, Q);
              for (Eigen::Index q = 0; q < Q; ++q) {
                const Index point = at(points, q);
                for (Offset e = at(rows.start, point); e < at(rows.start, point + 1); ++e)
                  at(N, i)(detail::position_in(particles, at(rows.particle, e)), q) += at(value, e);
              }
            }
            const auto shapes_of = [&](int i) -> const Eigen::MatrixXd& {
              return at(N, rows.folded ? i : 0);
            };
            M.setZero(D * Q, D * Q);
            make(g, M);
            auto block = element.resize(m * D);
            for (int i = 0; i < D; ++i)
              for (int j = i; j < D; ++j) {
                NM.noalias() = shapes_of(i) * M.block(i * Q, j * Q, Q, Q);
                block.block(i * m, j * m, m, m).noalias() = NM * shapes_of(j).transpose();
              }
          });
  }

 private:
  std::vector<Index> particles_of(const PointRows<D>& rows, std::size_t group) const {
    std::vector<Index> particles;
    for (const Index point : groups_[group]) {
      const std::span<const Index> row = rows.of_rows(point, point + 1);
      particles.insert(particles.end(), row.begin(), row.end());
    }
    std::sort(particles.begin(), particles.end());
    particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
    return particles;
  }

  std::vector<std::vector<Index>> groups_;  // points
  Index first_element_ = -1;
};

}  // namespace meniscus
