// SPDX-License-Identifier: BSD-3-Clause
// Builds the integration rules that have points: at Gauss points and at particles.
#include "body/body.hpp"
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

/// The particle nearest to a point, among the particles in the row of the point.
template <int D>
Index nearest(const Body<D>& body, const PointRows<D>& rows, Index point, const Vec<D>& X) {
  Index owner = 0;
  Real least = unbounded;
  for (Offset e = at(rows.start, point); e < at(rows.start, point + 1); ++e) {
    const Index A = at(rows.particle, e);
    const Real distance = (at(body.particles.X(), A) - X).squaredNorm();
    if (distance < least) {
      least = distance;
      owner = A;
    }
  }
  return owner;
}

template <int D>
PointRule<D> make_point_rule(const Body<D>& body, std::span<const Vec<D>> points,
                             std::vector<Real> weight, Index per_group) {
  const auto n = static_cast<Index>(points.size());
  const Index groups = (n + per_group - 1) / per_group;
  const OwnItems own_groups = body.division.own_rows(groups),
                 own{std::min(n, own_groups.begin * per_group),
                     std::min(n, own_groups.end * per_group)};
  PointRule<D> rule;
  rule.per_group = per_group;
  on_each_rank([&] {
    rule.rows = build_point_rows<D>(body.particles, points, {.gradient = true}, body.name, own);
  });
  rule.point_weight = std::move(weight);
  rule.point_owner.resize(static_cast<std::size_t>(groups * per_group));
  parallel_for(own, [&](Index q) {
    at(rule.point_owner, q) = nearest<D>(body, rule.rows, q, at(points, q));
  });
  body.division.complete_rows(groups, rule.point_owner.data(),
                              static_cast<std::size_t>(per_group) * sizeof(Index));
  rule.point_owner.resize(points.size());
  return rule;
}

}  // namespace

template <int D>
PointRule<D> build_gauss_rule(const Body<D>& body, int points_per_direction, Index per_group) {
  auto points = cell_gauss_points(body.geometry.grid, points_per_direction);
  return make_point_rule<D>(body, points.X, std::move(points.weight), per_group);
}

template <int D>
PointRule<D> build_nodal_rule(const Body<D>& body, Index per_group) {
  std::vector<Real> volume;
  for (Index A = 0; A < body.size(); ++A) volume.push_back(body.cells.volume(A));
  return make_point_rule<D>(body, body.particles.X(), std::move(volume), per_group);
}

template <int D>
std::vector<Real> shape_integrals(const Body<D>& body) {
  // The rule is exact for first moments: X det J has degree 2 D + 1 per direction in curved cells.
  const auto points =
      cell_gauss_points(body.geometry.grid, body.geometry.grid.bulges.empty() ? 3 : D + 1);
  std::vector<Real> integral(static_cast<std::size_t>(body.size()), 0.0);
  constexpr std::size_t block = 20000;  // in blocks, since rows of all points would need more
                                        // memory than the rule
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

#define MENISCUS_INSTANTIATE(D)                                       \
  template PointRule<D> build_gauss_rule(const Body<D>&, int, Index); \
  template PointRule<D> build_nodal_rule(const Body<D>&, Index);      \
  template std::vector<Real> shape_integrals(const Body<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
