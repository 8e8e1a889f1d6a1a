// SPDX-License-Identifier: BSD-3-Clause
// Rows of the nodal cells of a body of revolution: their integrals, and the sums over a row in the
// time loop (axisymmetry note 3).
#include "body/grid/folded_cells.hpp"

#include "numbers/dense.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace meniscus {
namespace {

/// The coefficients of the row of one component: integrals of N, with X relative to the centroid of
/// the cell.
struct ComponentIntegrals {
  Real plain = 0;                         ///< 2 pi INT N dA
  Vec<2> first = Vec<2>::Zero();          ///< 2 pi INT N X_M dA
  Vec<2> flux = Vec<2>::Zero();           ///< CLOSED INT N n_K 2 pi R ds
  Mat<2> flux_of_first = Mat<2>::Zero();  ///< CLOSED INT N n_K X_M 2 pi R ds

  void add_volume(Real N, Real dA, const Vec<2>& X) {
    const Real w = 2 * std::numbers::pi * dA * N;
    plain += w;
    first += w * X;
  }
  void add_facet(Real N, const Vec<2>& n_ds, const Vec<2>& X) {
    flux += N * n_ds;
    flux_of_first += N * n_ds * X.transpose();
  }
  /// INT N 2 pi R dA, with the centroid at the distance R from the axis.
  Real volume(Real R) const { return R * plain + first[0]; }
};

struct Entry {
  Index particle;
  std::array<ComponentIntegrals, 2> of;  ///< odd component, even component
};

/// Sums the integrals of one cell after the other, with the storage of the last.
class CellSums {
 public:
  explicit CellSums(const Body<2>& body) : body_(body), slot_(body.particles.X().size(), -1) {}

  /// The integrals of a cell, by ascending particle.
  const std::vector<Entry>& of(Index cell) {
    entries_.clear();
    body_.cells.quadrature(cell, q_);
    const Vec<2>& centroid = body_.cells.centroid(cell);
    add(q_.volume_X, [&](ComponentIntegrals& sum, Real N, std::size_t p) {
      sum.add_volume(N, q_.volume_w[p], q_.volume_X[p] - centroid);
    });
    for (std::size_t p = 0; p < q_.facet_X.size(); ++p)
      q_.facet_dA[p] *= circle(body_.geometry.grid, q_.facet_X[p]);
    add(q_.facet_X, [&](ComponentIntegrals& sum, Real N, std::size_t p) {
      sum.add_facet(N, q_.facet_dA[p], q_.facet_X[p] - centroid);
    });
    for (const Entry& entry : entries_) at(slot_, entry.particle) = -1;
    std::sort(entries_.begin(), entries_.end(),
              [](const Entry& a, const Entry& b) { return a.particle < b.particle; });
    return entries_;
  }

 private:
  template <class F>
  void add(const std::vector<Vec<2>>& points, F&& add_one) {
    const PointRows<2> rows =
        build_point_rows<2>(body_.particles, points, {.value = true}, body_.name);
    for (Index p = 0; p < rows.size(); ++p)
      for (Offset e = at(rows.start, p); e < at(rows.start, p + 1); ++e) {
        Index& slot = at(slot_, at(rows.particle, e));
        if (slot < 0) {
          slot = static_cast<Index>(entries_.size());
          entries_.push_back({at(rows.particle, e), {}});
        }
        auto& [odd, even] = at(entries_, slot).of;
        add_one(odd, at(rows.odd_value, e), static_cast<std::size_t>(p));
        add_one(even, at(rows.value, e), static_cast<std::size_t>(p));
      }
  }

  const Body<2>& body_;
  CellQuadrature<2> q_;
  std::vector<Index> slot_;  // [particle] number of its entry, or -1
  std::vector<Entry> entries_;
};

Lanes packed(Real mean, const Vec<2>& slope) {
  return {mean, slope[0], slope[1], 0};
}

/// The numbers (a_K, B_K0, B_K1) of one component.
std::array<Lanes, 2> gradient_of(const ComponentIntegrals& sum, Real R, Real W,
                                 const Mat<2>& inverse_WS) {
  std::array<Lanes, 2> g;
  for (int K = 0; K < 2; ++K) {
    const bool across = K == 0;
    Vec<2> moment = sum.flux_of_first.row(K).transpose();
    moment[K] -= sum.volume(R);
    if (across) moment -= sum.first;
    at(g, K) = packed((sum.flux[K] - (across ? sum.plain : 0)) / W, inverse_WS * moment);
  }
  return g;
}

/// The row of one cell, ready to be appended.
struct FoldedRow {
  std::vector<Index> particle;
  std::vector<Real> integral;
  std::vector<Lanes> even, odd;  ///< as CellRule::coefficient and CellRule::odd
};

FoldedRow row_of(const Body<2>& body, Index cell, CellSums& sums) {
  const Real W = body.cells.volume(cell), R = body.cells.centroid(cell)[0];
  const Mat<2> inverse_WS = inverse<2>(W * body.cells.covariance(cell));
  FoldedRow row;
  for (const auto& [particle, of] : sums.of(cell)) {
    const auto& [odd, even] = of;
    row.particle.push_back(particle);
    row.integral.push_back(even.volume(R));
    for (const Lanes& g : gradient_of(even, R, W, inverse_WS)) row.even.push_back(g);
    for (const Lanes& g : gradient_of(odd, R, W, inverse_WS)) row.odd.push_back(g);
    row.odd.push_back(packed(odd.plain / W, inverse_WS * odd.first));
  }
  return row;
}

}  // namespace

void append_folded_rows(const Body<2>& body, OwnItems cells, CellRule<2>& rule,
                        SumsOverRanks& shape_integral) {
  rule.start.resize(static_cast<std::size_t>(cells.begin) + 1, 0);
  std::vector<FoldedRow> rows(static_cast<std::size_t>(cells.end - cells.begin));
  constexpr Index at_once = 16;
  parallel_for((cells.end - cells.begin + at_once - 1) / at_once,
               [&](Index part) {
                 CellSums sums(body);
                 const Index begin = cells.begin + part * at_once;
                 for (Index cell = begin; cell < std::min(cells.end, begin + at_once); ++cell)
                   at(rows, cell - cells.begin) = row_of(body, cell, sums);
               },
               1);
  for (const FoldedRow& row : rows) {
    for (std::size_t e = 0; e < row.particle.size(); ++e)
      shape_integral.add(row.particle[e], row.integral[e]);
    rule.particle.insert(rule.particle.end(), row.particle.begin(), row.particle.end());
    rule.coefficient.insert(rule.coefficient.end(), row.even.begin(), row.even.end());
    rule.odd.insert(rule.odd.end(), row.odd.begin(), row.odd.end());
    rule.start.push_back(static_cast<Offset>(rule.particle.size()));
  }
}

namespace {

/// A number whose moments are (mean, slope along x, slope along y), at the stress points of a cell.
Lanes at_points(const Lanes& moments, const Lanes* xi) {
  return moments[0] + moments[1] * xi[0] + moments[2] * xi[1];
}

/// The transpose of at_points().
Lanes moments_of(Lanes P, const Lanes* xi) {
  return sums(P, P * xi[0], P * xi[1], Lanes::zero());
}

}  // namespace

void gather_folded(const CellRule<2>& rule, Index cell, const NodalVector* field,
                   Tensor<Lanes>& H) {
  Lanes moment[5];  // of H_00, H_01, H_22, H_10, H_11
  for (Lanes& m : moment) m = Lanes::zero();
  const Lanes *g = rule.coefficient.data() + at(rule.start, cell) * 2,
              *o = rule.odd.data() + at(rule.start, cell) * 3;
  for (Offset e = at(rule.start, cell); e < at(rule.start, cell + 1); ++e, g += 2, o += 3) {
    const Real* f = detail::components(field[at(rule.particle, e)]);
    for (int k = 0; k < 3; ++k) moment[k] += f[0] * o[k];
    for (int k = 0; k < 2; ++k) moment[3 + k] += f[1] * g[k];
  }
  const Lanes* xi = rule.point.data() + static_cast<std::size_t>(cell) * 2;
  H = Tensor<Lanes>::zero();
  H(0, 0) = at_points(moment[0], xi);
  H(0, 1) = at_points(moment[1], xi);
  H(2, 2) = at_points(moment[2], xi);
  H(1, 0) = at_points(moment[3], xi);
  H(1, 1) = at_points(moment[4], xi);
}

void scatter_folded(const CellRule<2>& rule, Index cell, const Tensor<Lanes>& P,
                    NodalVector* force) {
  const Lanes* xi = rule.point.data() + static_cast<std::size_t>(cell) * 2;
  const Lanes moment[5] = {moments_of(P(0, 0), xi), moments_of(P(0, 1), xi),
                           moments_of(P(2, 2), xi), moments_of(P(1, 0), xi),
                           moments_of(P(1, 1), xi)};
  const Lanes *g = rule.coefficient.data() + at(rule.start, cell) * 2,
              *o = rule.odd.data() + at(rule.start, cell) * 3;
  for (Offset e = at(rule.start, cell); e < at(rule.start, cell + 1); ++e, g += 2, o += 3)
    force[at(rule.particle, e)] +=
        sums(moment[0] * o[0] + moment[1] * o[1] + moment[2] * o[2],
             moment[3] * g[0] + moment[4] * g[1], Lanes::zero(), Lanes::zero());
}

void add_folded_diagonal(const CellRule<2>& rule, Index cell, const std::array<Tensor<Lanes>, 2>& S,
                         NodalVector* sum) {
  const Lanes* xi = rule.point.data() + static_cast<std::size_t>(cell) * 2;
  for (Offset e = at(rule.start, cell); e < at(rule.start, cell + 1); ++e)
    for (int i = 0; i < 2; ++i) {
      const Lanes* of = i == 0 ? rule.odd.data() + e * 3 : rule.coefficient.data() + e * 2;
      const std::array<Lanes, 2> g{at_points(of[0], xi), at_points(of[1], xi)};
      Lanes square = Lanes::zero();
      if (i == 0) {  // circles resist like edges across the axis
        const Lanes h = at_points(of[2], xi);
        square = at(S, 0)(0, 0) * h * h;
      }
      for (int K = 0; K < 2; ++K)
        for (int L = 0; L < 2; ++L) square += at(S, i)(K, L) * at(g, K) * at(g, L);
      NodalVector& total = sum[at(rule.particle, e)];
      total.set(i, total[i] + meniscus::sum(square));
    }
}

void gather_folded(const PointRule<2>& rule, Index group, const NodalVector* field,
                   Tensor<Lanes>& H) {
  const PointRows<2>& rows = rule.rows;
  H = Tensor<Lanes>::zero();
  for (int lane = 0; lane < rule.count(group); ++lane) {
    const Index q = group * rule.per_group + lane;
    Real across = 0;
    std::array<Real, 4> g{};  // H_00, H_01, H_10, H_11
    for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e) {
      const Real* f = detail::components(field[at(rows.particle, e)]);
      across += at(rows.odd_value, e) * f[0];
      for (std::size_t K = 0; K < 2; ++K) {
        g[K] += at(rows.odd_gradient, e * 2 + static_cast<Offset>(K)) * f[0];
        g[2 + K] += at(rows.gradient, e * 2 + static_cast<Offset>(K)) * f[1];
      }
    }
    H(0, 0).set(lane, g[0]);
    H(0, 1).set(lane, g[1]);
    H(1, 0).set(lane, g[2]);
    H(1, 1).set(lane, g[3]);
    H(2, 2).set(lane, across / at(rows.radius, q));
  }
}

void scatter_folded(const PointRule<2>& rule, Index group, const Tensor<Lanes>& P,
                    NodalVector* force) {
  const PointRows<2>& rows = rule.rows;
  for (int lane = 0; lane < rule.count(group); ++lane) {
    const Index q = group * rule.per_group + lane;
    const Real circles = P(2, 2)[lane] / at(rows.radius, q);
    for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e) {
      const Real *odd = &at(rows.odd_gradient, e * 2), *even = &at(rows.gradient, e * 2);
      force[at(rows.particle, e)] +=
          Lanes(P(0, 0)[lane] * odd[0] + P(0, 1)[lane] * odd[1] + circles * at(rows.odd_value, e),
                P(1, 0)[lane] * even[0] + P(1, 1)[lane] * even[1], 0, 0);
    }
  }
}

void add_folded_diagonal(const PointRule<2>& rule, Index group,
                         const std::array<Tensor<Lanes>, 2>& S, NodalVector* sum) {
  const PointRows<2>& rows = rule.rows;
  for (int lane = 0; lane < rule.count(group); ++lane) {
    const Index q = group * rule.per_group + lane;
    for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e) {
      const Real *odd = &at(rows.odd_gradient, e * 2), *even = &at(rows.gradient, e * 2),
                 h = at(rows.odd_value, e) / at(rows.radius, q);
      Real across = S[0](0, 0)[lane] * h * h, along = 0;
      for (int K = 0; K < 2; ++K)
        for (int L = 0; L < 2; ++L) {
          across += S[0](K, L)[lane] * odd[K] * odd[L];
          along += S[1](K, L)[lane] * even[K] * even[L];
        }
      sum[at(rows.particle, e)] += Lanes(across, along, 0, 0);
    }
  }
}

}  // namespace meniscus
