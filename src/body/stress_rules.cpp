// SPDX-License-Identifier: BSD-3-Clause
// Building the integration rules of a body: nodal cells with linear moments, Gauss points,
// particles.
#include "meniscus/body/body.hpp"
#include "meniscus/core/dense.hpp"
#include "meniscus/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

/// sum_k += sum_q weight_q N_k(x_q) for all candidates k. Points come in fours that are close
/// together; candidates that reach none of the four are left out.
template <int D, class Weight, class Sum>
void add_integrals(const Body<D>& body, std::span<const Vec<D>> points,
                   std::span<const Weight> weight, std::span<const Candidate<D>> candidates,
                   std::vector<Sum>& integral) {
  thread_local ReproducingKernel<D> kernel(body.particles.window());  // keeps its buffers
  thread_local std::vector<Candidate<D>> near;
  thread_local std::vector<std::size_t> number;
  kernel.use(body.particles.window());
  for (std::size_t q = 0; q < points.size(); q += 4) {
    std::array<Vec<D>, 4> batch;  // the last point fills up, with weight zero
    std::array<Weight, 4> batch_weight{};
    for (std::size_t lane = 0; lane < 4; ++lane) {
      batch[lane] = points[std::min(q + lane, points.size() - 1)];
      if (q + lane < points.size()) batch_weight[lane] = weight[q + lane];
    }
    const auto places = body.particles.kernel_places(batch);
    select_near<D>(places, candidates, near, number);
    kernel.evaluate(places, near, Derivatives::none);
    for (std::size_t lane = 0; lane < 4; ++lane)
      body.particles.require_quality(kernel.quality()[static_cast<int>(lane)], batch[lane],
                                     body.name);
    for (std::size_t k = 0; k < near.size(); ++k)
      integral[number[k]].add(kernel.value(k), batch_weight);
  }
}

/// Integral of N over the cell.
struct VolumeIntegral {
  Real value = 0;
  void add(Lanes N, const std::array<Real, 4>& w) {
    value += sum(N * Lanes(w[0], w[1], w[2], w[3]));
  }
};

/// Integrals of N n_K (1, X - Xb) over the boundary of the cell, which is also the weight at a
/// point: lane 0 the moment of order 0, lanes 1 + Q those of order 1.
template <int D>
struct Flux {
  std::array<Lanes, D> moment{};
  Flux() = default;
  Flux(const Vec<D>& n_dA, const Vec<D>& from_centroid) {
    Lanes one_and_X = Lanes::zero();
    one_and_X.set(0, 1);
    for (int Q = 0; Q < D; ++Q) one_and_X.set(1 + Q, from_centroid[Q]);
    for (int K = 0; K < D; ++K) at(moment, K) = n_dA[K] * one_and_X;
  }
  bool is_zero() const {
    Lanes size = Lanes::zero();
    for (const Lanes& m : moment) size += max(m, -m);
    return sum(size) == 0;
  }
  void add(Lanes N, const std::array<Flux, 4>& weight) {
    for (int lane = 0; lane < 4; ++lane)
      for (int K = 0; K < D; ++K) at(moment, K) += N[lane] * at(at(weight, lane).moment, K);
  }
};

/// One row of the cell rule, before it is packed.
template <int D>
struct CellRow {
  std::vector<Candidate<D>> candidates;
  std::vector<VolumeIntegral> integral;        // [candidate]
  std::vector<std::array<Lanes, D>> gradient;  // [candidate][K]: (a_K, B_K.)
};

/// Flux integrals of one nodal cell: a_K = (1/V) oint N n_K,
/// B_KM = [oint N n_K (X - Xb)_Q - delta_KQ int N] (V S)^-1_QM.
template <int D>
void integrate_cell(const Body<D>& body, Index cell, CellRow<D>& row) {
  thread_local CellQuadrature<D> quadrature;
  body.cells.quadrature(cell, quadrature);
  const Vec<D>& centroid = body.cells.centroid(cell);
  Real radius = 0;
  for (const auto* points : {&quadrature.volume_X, &quadrature.facet_X})
    for (const Vec<D>& x : *points) radius = std::max(radius, (x - centroid).norm());
  body.particles.candidates(centroid, radius * (1 + 1e-12), row.candidates);

  const std::size_t n = row.candidates.size();
  thread_local std::vector<Flux<D>> facet_weight, flux;
  facet_weight.clear();
  for (std::size_t q = 0; q < quadrature.facet_X.size(); ++q)
    facet_weight.emplace_back(quadrature.facet_dA[q], quadrature.facet_X[q] - centroid);
  flux.assign(n, {});
  row.integral.assign(n, {});
  add_integrals<D, Real>(body, quadrature.volume_X, quadrature.volume_w, row.candidates,
                         row.integral);
  add_integrals<D, Flux<D>>(body, quadrature.facet_X, facet_weight, row.candidates, flux);

  const Real V = body.cells.volume(cell);
  const Mat<D> inverse_VS = inverse<D>(V * body.cells.covariance(cell));
  row.gradient.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    Mat<D> moment;
    for (int K = 0; K < D; ++K)
      for (int Q = 0; Q < D; ++Q) moment(K, Q) = at(flux[k].moment, K)[1 + Q];
    const Mat<D> B = (moment - row.integral[k].value * Mat<D>::Identity()) * inverse_VS;
    for (int K = 0; K < D; ++K) {
      Lanes& g = at(row.gradient[k], K);
      g = Lanes::zero();
      g.set(0, at(flux[k].moment, K)[0] / V);
      for (int M = 0; M < D; ++M) g.set(1 + M, B(K, M));
    }
  }
  // Drop the candidates whose support meets no quadrature point.
  std::size_t kept = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (row.integral[k].value == 0 && flux[k].is_zero()) continue;
    row.candidates[kept] = row.candidates[k];
    row.integral[kept] = row.integral[k];
    row.gradient[kept++] = row.gradient[k];
  }
  row.candidates.resize(kept);
  row.integral.resize(kept);
  row.gradient.resize(kept);
}

/// For as many entries as all rows have, by what some of them have and a quarter more: what is not
/// filled takes no memory, but growing would take twice as much for a moment.
template <int D>
void reserve_entries(const Body<D>& body, CellRule<D>& rule) {
  constexpr Index samples = 256;
  const Index n = body.size(), step = (n + samples - 1) / samples;
  CellRow<D> row;
  std::size_t entries = 0;
  for (Index cell = step / 2; cell < n; cell += step) {
    integrate_cell(body, cell, row);
    entries += row.candidates.size() * static_cast<std::size_t>(step);
  }
  entries += entries / 4;
  rule.particle.reserve(entries);
  rule.coefficient.reserve(entries * D);
}

/// Vertices of the regular simplex with sum t = 0 and mean t t^T = I / D.
template <int D>
std::array<Vec<D>, D + 1> simplex() {
  if constexpr (D == 3) {
    const Real t = 1 / std::sqrt(3.0);
    return {Vec<3>(t, t, t), Vec<3>(t, -t, -t), Vec<3>(-t, t, -t), Vec<3>(-t, -t, t)};
  } else {
    const Real s = std::sqrt(0.75);
    return {Vec<2>(1, 0), Vec<2>(-0.5, s), Vec<2>(-0.5, -s)};
  }
}

/// xi_q = sqrt(D) S^(1/2) t_q, a lane per q.
template <int D>
std::array<Lanes, D> stress_points(const Mat<D>& S) {
  const Mat<D> root = square_root<D>(S);
  const auto t = simplex<D>();
  std::array<Lanes, D> xi;
  xi.fill(Lanes::zero());
  for (int q = 0; q <= D; ++q)
    for (int M = 0; M < D; ++M)
      at(xi, M).set(q, std::sqrt(Real(D)) * (root.row(M) * at(t, q)).value());
  return xi;
}

template <int D>
PointRule<D> make_point_rule(const Body<D>& body, std::span<const Vec<D>> points,
                             std::vector<Real> weight) {
  PointRule<D> rule;
  rule.rows = build_point_rows<D>(body.particles, points, {.gradient = true}, body.name);
  rule.point_weight = std::move(weight);
  rule.point_owner.resize(points.size());
  parallel_for(static_cast<Index>(points.size()), [&](Index q) {
    Real nearest = unbounded;
    for (Offset e = at(rule.rows.start, q); e < at(rule.rows.start, q + 1); ++e) {
      const Index A = at(rule.rows.particle, e);
      const Real distance = (at(body.particles.X(), A) - at(points, q)).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        at(rule.point_owner, q) = A;
      }
    }
  });
  return rule;
}

}  // namespace

template <int D>
CellOperator<D> build_cell_rule(const Body<D>& body) {
  const Index n = body.size();
  CellOperator<D> op;
  CellRule<D>& rule = op.rule;
  op.shape_integral.assign(static_cast<std::size_t>(n), 0.0);
  reserve_entries(body, rule);
  constexpr Index block = 1024;  // rows take three times as much before they are packed
  std::vector<CellRow<D>> rows(static_cast<std::size_t>(std::min(block, n)));
  for (Index begin = 0; begin < n; begin += block) {
    const Index count = std::min(block, n - begin);
    parallel_for(
        count, [&](Index k) { integrate_cell(body, begin + k, at(rows, k)); }, 4);
    for (Index k = 0; k < count; ++k) {
      const CellRow<D>& row = at(rows, k);
      for (std::size_t e = 0; e < row.candidates.size(); ++e) {
        rule.particle.push_back(row.candidates[e].particle);
        for (const Lanes& g : row.gradient[e]) rule.coefficient.push_back(g);
        at(op.shape_integral, row.candidates[e].particle) += row.integral[e].value;
      }
      rule.start.push_back(static_cast<Offset>(rule.particle.size()));
      rule.volume.push_back(body.cells.volume(begin + k));
      for (const Lanes& xi : stress_points<D>(body.cells.covariance(begin + k)))
        rule.point.push_back(xi);
    }
  }
  return op;
}

template <int D>
PointRule<D> build_gauss_rule(const Body<D>& body, int points_per_direction) {
  auto points = cell_gauss_points(body.geometry.grid, points_per_direction);
  return make_point_rule<D>(body, points.X, std::move(points.weight));
}

template <int D>
PointRule<D> build_nodal_rule(const Body<D>& body) {
  std::vector<Real> volume;
  for (Index A = 0; A < body.size(); ++A) volume.push_back(body.cells.volume(A));
  return make_point_rule<D>(body, body.particles.X(), std::move(volume));
}

template <int D>
std::vector<Real> shape_integrals(const Body<D>& body) {
  // First moments are exact: X det J has degree 2 D + 1 per direction in curved cells.
  const auto points =
      cell_gauss_points(body.geometry.grid, body.geometry.grid.bulges.empty() ? 3 : D + 1);
  std::vector<Real> integral(static_cast<std::size_t>(body.size()), 0.0);
  constexpr std::size_t block = 20000;  // rows of all points would be larger than the rule
  for (std::size_t begin = 0; begin < points.X.size(); begin += block) {
    const std::size_t end = std::min(begin + block, points.X.size());
    const std::vector<Vec<D>> X(points.X.begin() + static_cast<std::ptrdiff_t>(begin),
                                points.X.begin() + static_cast<std::ptrdiff_t>(end));
    const auto rows = build_point_rows<D>(body.particles, X, {.value = true}, body.name);
    for (Index q = 0; q < rows.size(); ++q)
      for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e)
        at(integral, at(rows.particle, e)) +=
            points.weight[begin + static_cast<std::size_t>(q)] * at(rows.value, e);
  }
  return integral;
}

#define MENISCUS_INSTANTIATE(D)                                \
  template CellOperator<D> build_cell_rule(const Body<D>&);    \
  template PointRule<D> build_gauss_rule(const Body<D>&, int); \
  template PointRule<D> build_nodal_rule(const Body<D>&);      \
  template std::vector<Real> shape_integrals(const Body<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
