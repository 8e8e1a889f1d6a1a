// SPDX-License-Identifier: BSD-3-Clause
// Building the integration rules of a body: nodal cells with linear moments, Gauss points,
// particles.
#include "meniscus/body/body.hpp"
#include "meniscus/core/error.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

namespace meniscus {
namespace {

/// Calls f(point number, candidate number, N) for every shape function at every point. Points come
/// in fours that are close together; candidates that reach none of the four are left out.
template <int D, class F>
void for_each_value(const ParticleSet<D>& particles, ReproducingKernel<D>& kernel,
                    std::span<const Vec<D>> points, std::span<const Candidate<D>> candidates,
                    const std::string& body, F&& f) {
  thread_local std::vector<Candidate<D>> near;
  thread_local std::vector<std::size_t> number;
  for (std::size_t q = 0; q < points.size(); q += 4) {
    std::array<Vec<D>, 4> batch;
    for (std::size_t lane = 0; lane < 4; ++lane)
      batch[lane] = points[std::min(q + lane, points.size() - 1)];
    select_near<D>(batch, candidates, near, number);
    kernel.evaluate(batch, near, Derivatives::none);
    const std::size_t lanes = std::min<std::size_t>(4, points.size() - q);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      particles.require_quality(kernel.quality()[static_cast<int>(lane)], batch[lane], body);
    for (std::size_t k = 0; k < near.size(); ++k)
      for (std::size_t lane = 0; lane < lanes; ++lane)
        f(q + lane, number[k], kernel.value(k)[static_cast<int>(lane)]);
  }
}

/// One row of the cell rule, before it is packed.
template <int D>
struct CellRow {
  std::vector<Candidate<D>> candidates;
  std::vector<Real> integral;                  // [candidate] of N over the cell
  std::vector<std::array<Lanes, D>> gradient;  // [candidate][K]: (a_K, B_K.)
};

/// Flux integrals of one nodal cell: a_K = (1/V) oint N n_K,
/// B_KM = [oint N n_K (X - Xb)_Q - delta_KQ int N] (V S)^-1_QM.
template <int D>
void integrate_cell(const Body<D>& body, Index cell, CellQuadrature<D>& quadrature,
                    ReproducingKernel<D>& kernel, CellRow<D>& row) {
  body.cells.quadrature(cell, quadrature);
  const Vec<D>& centroid = body.cells.centroid(cell);
  Real radius = 0;
  for (const auto* points : {&quadrature.volume_X, &quadrature.facet_X})
    for (const Vec<D>& x : *points) radius = std::max(radius, (x - centroid).norm());
  body.particles.candidates(centroid, radius * (1 + 1e-12), row.candidates);

  const std::size_t n = row.candidates.size();
  using Moments = Eigen::Matrix<Real, D, D + 1>;  // oint N n_K (1, X - Xb)
  thread_local std::vector<Moments> flux;
  flux.assign(n, Moments::Zero());
  row.integral.assign(n, 0.0);
  for_each_value<D>(
      body.particles, kernel, quadrature.volume_X, row.candidates, body.name,
      [&](std::size_t q, std::size_t k, Real N) { row.integral[k] += quadrature.volume_w[q] * N; });
  for_each_value<D>(body.particles, kernel, quadrature.facet_X, row.candidates, body.name,
                    [&](std::size_t q, std::size_t k, Real N) {
                      const Vec<D> n_dA = N * quadrature.facet_dA[q];
                      flux[k].col(0) += n_dA;
                      flux[k].template rightCols<D>() +=
                          n_dA * (quadrature.facet_X[q] - centroid).transpose();
                    });

  const Real V = body.cells.volume(cell);
  const Mat<D> inverse_VS = (V * body.cells.covariance(cell)).inverse();
  row.gradient.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec<D> a = flux[k].col(0) / V;
    const Mat<D> B =
        (flux[k].template rightCols<D>() - row.integral[k] * Mat<D>::Identity()) * inverse_VS;
    for (int K = 0; K < D; ++K) {
      at(row.gradient[k], K) = Lanes::zero();
      at(row.gradient[k], K).set(0, a[K]);
      for (int M = 0; M < D; ++M) at(row.gradient[k], K).set(1 + M, B(K, M));
    }
  }
  // Drop the candidates whose support meets no quadrature point.
  std::size_t kept = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (row.integral[k] == 0 && flux[k].isZero(0)) continue;
    row.candidates[kept] = row.candidates[k];
    row.integral[kept] = row.integral[k];
    row.gradient[kept++] = row.gradient[k];
  }
  row.candidates.resize(kept);
  row.integral.resize(kept);
  row.gradient.resize(kept);
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
  const Eigen::SelfAdjointEigenSolver<Mat<D>> eigen(S);
  const Mat<D> root = eigen.operatorSqrt();
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
    Real nearest = 1e300;
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
  std::vector<CellRow<D>> rows(static_cast<std::size_t>(n));
  parallel_for(
      n,
      [&](Index L) {
        thread_local CellQuadrature<D> quadrature;
        ReproducingKernel<D> kernel(body.particles.window());
        integrate_cell(body, L, quadrature, kernel, at(rows, L));
      },
      4);

  CellOperator<D> op;
  CellRule<D>& rule = op.rule;
  op.shape_integral.assign(static_cast<std::size_t>(n), 0.0);
  std::size_t entries = 0;
  for (const CellRow<D>& row : rows) entries += row.candidates.size();
  rule.particle.reserve(entries);
  rule.coefficient.reserve(entries * D);
  for (Index L = 0; L < n; ++L) {
    CellRow<D>& row = at(rows, L);
    for (std::size_t k = 0; k < row.candidates.size(); ++k) {
      rule.particle.push_back(row.candidates[k].particle);
      for (const Lanes& g : row.gradient[k]) rule.coefficient.push_back(g);
      at(op.shape_integral, row.candidates[k].particle) += row.integral[k];
    }
    rule.start.push_back(static_cast<Offset>(rule.particle.size()));
    rule.volume.push_back(body.cells.volume(L));
    for (const Lanes& xi : stress_points<D>(body.cells.covariance(L))) rule.point.push_back(xi);
    row = {};
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
  const auto rows = build_point_rows<D>(body.particles, points.X, {.value = true}, body.name);
  std::vector<Real> integral(static_cast<std::size_t>(body.size()), 0.0);
  for (Index q = 0; q < rows.size(); ++q)
    for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e)
      at(integral, at(rows.particle, e)) += at(points.weight, q) * at(rows.value, e);
  return integral;
}

template <int D>
MassReport lump_mass(Body<D>& body, const std::vector<Real>& density,
                     const std::vector<Real>& shape_integral) {
  MassReport report;
  Real before = 0, after = 0;
  body.mass.resize(shape_integral.size());
  for (Index A = 0; A < body.size(); ++A) {
    const Real row_sum = at(density, A) * at(shape_integral, A);
    const Real floor = 0.3 * at(density, A) * body.cells.volume(A);
    at(body.mass, A) = std::max(row_sum, floor);
    report.raised += row_sum < floor;
    before += row_sum;
    after += at(body.mass, A);
  }
  report.added = after / before - 1;
  return report;
}

#define MENISCUS_INSTANTIATE(D)                                \
  template CellOperator<D> build_cell_rule(const Body<D>&);    \
  template PointRule<D> build_gauss_rule(const Body<D>&, int); \
  template PointRule<D> build_nodal_rule(const Body<D>&);      \
  template std::vector<Real> shape_integrals(const Body<D>&);  \
  template MassReport lump_mass(Body<D>&, const std::vector<Real>&, const std::vector<Real>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
