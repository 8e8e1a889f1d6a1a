// SPDX-License-Identifier: BSD-3-Clause
// Building the integration rules of a body that have points: Gauss points, particles.
#include "meniscus/body/body.hpp"
#include "meniscus/core/dense.hpp"
#include "meniscus/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

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
  template PointRule<D> build_gauss_rule(const Body<D>&, int); \
  template PointRule<D> build_nodal_rule(const Body<D>&);      \
  template std::vector<Real> shape_integrals(const Body<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
