// SPDX-License-Identifier: BSD-3-Clause
// Rows for the curvature of a surface.
#include "physics/surface/bending_rows.hpp"

#include "kernel/monomials.hpp"
#include "kernel/point_rows.hpp"
#include "kernel/row_sums.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

/// Orthonormal tangents t1, t2 with t1 x t2 = N.
std::array<Vec<3>, 2> tangents(const Vec<3>& N) {
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(N[k]) < std::abs(N[least])) least = k;
  const int next = (least + 1) % 3, last = (least + 2) % 3;
  Vec<3> t1 = Vec<3>::Zero();  // the unit vector `least` x N
  t1[next] = -N[last];
  t1[last] = N[next];
  t1 /= t1.norm();
  return {t1, Vec<3>(N[1] * t1[2] - N[2] * t1[1], N[2] * t1[0] - N[0] * t1[2],
                     N[0] * t1[1] - N[1] * t1[0])};
}

/// t.(hessian t') of packed second derivatives.
template <int D>
Real along(const Real* hessian, const Vec<D>& t, const Vec<D>& other) {
  Real sum = 0;
  for (int K = 0; K < D; ++K)
    for (int L = 0; L < D; ++L) sum += t[K] * hessian[hessian_index(D, K, L)] * other[L];
  return sum;
}
template <int D>
Real along(const Real* gradient, const Vec<D>& t) {
  Real sum = 0;
  for (int K = 0; K < D; ++K) sum += gradient[K] * t[K];
  return sum;
}

/// t.(hessian t') + gradient.X,ab, where X,ab = - bend N is the second derivative of the reference
/// surface along t and t'.
template <int D>
Real second(const Real* hessian, const Real* gradient, const Vec<D>& t, const Vec<D>& other,
            Real bend, const Vec<D>& N) {
  return along<D>(hessian, t, other) - bend * along<D>(gradient, N);
}

/// Whether these sites have no edges between them: a smooth surface, or one patch.
template <int D>
bool is_smooth(const Body<D>& body, const SurfaceSites& sites, const SurfacePoints<D>& surface) {
  if (sites.face.empty()) return body.geometry.surface->smooth();
  const auto patch_of = [&](Index facet) { return at(body.geometry.grid.facets, facet).patch; };
  return std::all_of(surface.facet.begin(), surface.facet.end(), [&](Index facet) {
    return patch_of(facet) == patch_of(surface.facet.front());
  });
}

}  // namespace

template <>
void BendingRows<3>::add_point(const PointRows<3>&, const SurfacePoints<3>&, Index);
template <>
void BendingRows<2>::add_point(const PointRows<2>&, const SurfacePoints<2>&, Index);

template <int D>
BendingRows<D>::BendingRows(const Body<D>& body, const SurfaceSites& sites) {
  const SurfacePoints<D> surface = points_at(body, sites);
  if (!is_smooth(body, sites, surface) || !surface.exact)
    throw InputError(
        fmt::format("body '{}': bending needs a smooth surface, but this {} has edges, where the "
                    "curvature is undefined; expected is a round shape such as ball, ellipsoid, "
                    "disk, a smooth mesh, or one face",
                    body.name, sites.face.empty() ? "shape" : "face"));
  const PointRows<D> rows = build_point_rows<D>(
      body.particles, surface.X, {.value = D == 2, .gradient = true, .hessian = true}, body.name);
  start_ = rows.start;
  particle_.assign(rows.particle.begin(), rows.particle.end());
  entry_.resize(particle_.size());
  area_ = surface.area;
  radius_ = rows.folded ? rows.radius : std::vector<Real>();
  rest_.resize(area_.size());
  parallel_for(size(), [&](Index q) { add_point(rows, surface, q); });
}

template <>
void BendingRows<3>::add_point(const PointRows<3>& rows, const SurfacePoints<3>& surface, Index q) {
  const Vec<3>& N = at(surface.N, q);
  const Mat<3>& grad_N = at(surface.grad_N, q);
  const auto [t1, t2] = tangents(N);
  const Real bend11 = t1.dot(grad_N * t1), bend22 = t2.dot(grad_N * t2),
             bend12 = (t1.dot(grad_N * t2) + t2.dot(grad_N * t1)) / 2;
  for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e) {
    const Real *gradient = rows.gradient.data() + e * 3,
               *hessian = rows.hessian.data() + e * hessian_count(3);
    at(entry_, e) = {along<3>(gradient, t1), along<3>(gradient, t2),
                     second<3>(hessian, gradient, t1, t1, bend11, N),
                     second<3>(hessian, gradient, t1, t2, bend12, N),
                     second<3>(hessian, gradient, t2, t2, bend22, N)};
  }
  const auto set = [&](std::size_t k, const Vec<3>& x) { at(rest_, q)[k] = {x[0], x[1], x[2]}; };
  set(0, t1);
  set(1, t2);
  set(2, -bend11 * N);
  set(3, -bend12 * N);
  set(4, -bend22 * N);
}

template <>
void BendingRows<2>::add_point(const PointRows<2>& rows, const SurfacePoints<2>& surface, Index q) {
  const Vec<2>& N = at(surface.N, q);
  const Vec<2> t(-N[1], N[0]);
  const Real bend = t.dot(at(surface.grad_N, q) * t);
  for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e) {
    const auto numbers_of = [&](const auto& value, const auto& gradient, const auto& hessian) {
      const Real *slope = gradient.data() + e * 2, *bent = hessian.data() + e * hessian_count(2);
      return std::array{at(value, e), along<2>(slope, t), second<2>(bent, slope, t, t, bend, N)};
    };
    const auto even = numbers_of(rows.value, rows.gradient, rows.hessian),
               odd = rows.folded ? numbers_of(rows.odd_value, rows.odd_gradient, rows.odd_hessian)
                                 : even;
    for (std::size_t k = 0; k < numbers; ++k)
      at(entry_, e)[k] = Lanes(odd[k], even[k], even[k], even[k]);
  }
  SurfaceDerivatives<Real>& rest = at(rest_, q);
  rest = {};
  rest[0] = {t[0], t[1], 0};
  rest[1][2] = 1;
  rest[2] = {-bend * N[0], -bend * N[1], 0};
  if (!rows.folded) return;
  rest[3][2] = t[0] / at(radius_, q);
  rest[4][0] = -1 / at(radius_, q);
}

template <int D>
SurfaceDerivatives<Real> BendingRows<D>::changes(Index q, const NodalVector* du) const {
  std::array<Lanes, numbers> sum;
  sum.fill(Lanes::zero());
  for (Offset e = at(start_, q); e < at(start_, q + 1); ++e) {
    const Lanes value = du[at(particle_, e)];
    for (std::size_t k = 0; k < numbers; ++k) sum[k] += at(entry_, e)[k] * value;
  }
  if constexpr (D == 3) {
    SurfaceDerivatives<Real> d;
    for (std::size_t k = 0; k < numbers; ++k) d[k] = {sum[k][0], sum[k][1], sum[k][2]};
    return d;
  } else {
    SurfaceDerivatives<Real> d{};
    d[0] = {sum[1][0], sum[1][1], 0};
    d[2] = {sum[2][0], sum[2][1], 0};
    if (radius_.empty()) return d;
    const Real radius = at(radius_, q);
    d[1][2] = sum[0][0] / radius;
    d[3][2] = sum[1][0] / radius;
    d[4][0] = -sum[0][0] / (radius * radius);
    return d;
  }
}

template <int D>
void BendingRows<D>::scatter(Index q, Real factor, const SurfaceDerivatives<Real>& slope,
                             NodalVector* force) const {
  std::array<Lanes, numbers> pull;
  if constexpr (D == 3) {
    for (std::size_t k = 0; k < numbers; ++k)
      pull[k] = factor * Lanes(slope[k][0], slope[k][1], slope[k][2], 0.0);
  } else {
    Real of_circle = 0, of_slope = 0;
    if (!radius_.empty()) {
      const Real radius = at(radius_, q);
      of_circle = (slope[1][2] - slope[4][0] / radius) / radius;
      of_slope = slope[3][2] / radius;
    }
    pull = {factor * Lanes(of_circle, 0.0, 0.0, 0.0),
            factor * Lanes(slope[0][0] + of_slope, slope[0][1], 0.0, 0.0),
            factor * Lanes(slope[2][0], slope[2][1], 0.0, 0.0)};
  }
  for (Offset e = at(start_, q); e < at(start_, q + 1); ++e) {
    Lanes& sum = force[at(particle_, e)];
    for (std::size_t k = 0; k < numbers; ++k) sum += at(entry_, e)[k] * pull[k];
  }
}

template <int D>
std::size_t BendingRows<D>::bytes() const {
  return start_.size() * sizeof(Offset) + particle_.size() * sizeof(Index) +
         entry_.size() * sizeof(Entry) + (area_.size() + radius_.size()) * sizeof(Real) +
         rest_.size() * sizeof(SurfaceDerivatives<Real>);
}

template class BendingRows<2>;
template class BendingRows<3>;

}  // namespace meniscus
