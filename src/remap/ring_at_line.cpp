// SPDX-License-Identifier: BSD-3-Clause
// Finds the ring around the wetted facets, and moves it along the surface to the contact line.
#include "remap/ring_at_line.hpp"

#include "numbers/dense.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace meniscus {
namespace {

/// Boundary nodes in rings around the pole, by the number of facets between them and the pole.
/// Empty if some node is not connected to the pole.
template <int D>
std::vector<std::vector<Index>> rings_around(Index pole, const Grid<D>& grid,
                                             const MovingNodes<D>& nodes) {
  std::vector<int> ring(grid.X.size(), -1);
  std::vector<std::vector<Index>> rings = {{pole}};
  at(ring, pole) = 0;
  while (true) {
    std::vector<Index> next;
    for (const Index node : rings.back())
      for (const Index f : nodes.facets_at(node))
        for (const Index other : at(grid.facets, f).nodes)
          if (at(ring, other) < 0) {
            at(ring, other) = static_cast<int>(rings.size());
            next.push_back(other);
          }
    if (next.empty()) return rings;
    std::sort(next.begin(), next.end());
    rings.push_back(std::move(next));
  }
}

/// The ring that encloses a fraction of the facets nearest to `fraction`. Empty if this is the pole
/// or the last ring.
template <int D>
std::optional<std::vector<Index>> ring_of(Real fraction,
                                          const std::vector<std::vector<Index>>& rings,
                                          const Grid<D>& grid) {
  std::vector<int> number(grid.X.size(), 0);
  for (std::size_t k = 0; k < rings.size(); ++k)
    for (const Index node : rings[k]) at(number, node) = static_cast<int>(k);
  std::vector<Real> enclosed(rings.size() + 1, 0);
  for (const Facet<D>& facet : grid.facets) {
    int outer = 0;
    for (const Index node : facet.nodes) outer = std::max(outer, at(number, node));
    for (auto k = static_cast<std::size_t>(outer); k < enclosed.size(); ++k)
      enclosed[k] += 1.0 / static_cast<Real>(grid.facets.size());
  }
  std::size_t best = 0;
  for (std::size_t k = 1; k < rings.size(); ++k)
    if (std::abs(enclosed[k] - fraction) < std::abs(enclosed[best] - fraction)) best = k;
  if (best < 1 || best + 1 >= rings.size()) return std::nullopt;
  return rings[best];
}

/// Middle of the facets whose gap is below that of the contact line; none if there is none.
template <int D>
std::optional<Vec<D>> middle_of_wetted(const ContactLine<D>& line, Real time, const Grid<D>& grid,
                                       const MovingNodes<D>& nodes) {
  Vec<D> middle = Vec<D>::Zero();
  Real area = 0;
  for (const Facet<D>& facet : grid.facets) {
    Vec<D> centre = Vec<D>::Zero();
    for (const Index node : facet.nodes)
      centre += at(nodes.x(), node) / static_cast<Real>(facet.nodes.size());
    if (line.gap(centre, time) >= line.level) continue;
    const Real a = area_of(facet, nodes.x()).norm();
    middle += a * centre;
    area += a;
  }
  return area > 0 ? std::optional<Vec<D>>(middle / area) : std::nullopt;
}

template <int D>
Index boundary_node_nearest_to(const Vec<D>& middle, const Grid<D>& grid,
                               const MovingNodes<D>& nodes) {
  Index pole = grid.facets.front().nodes[0];
  for (const Facet<D>& facet : grid.facets)
    for (const Index node : facet.nodes)
      if ((at(nodes.x(), node) - middle).norm() < (at(nodes.x(), pole) - middle).norm())
        pole = node;
  return pole;
}

/// Directions from the middle to the nodes of the ring, perpendicular to the axis.
template <int D>
std::vector<Vec<D>> directions_of(const std::vector<Index>& ring, const Vec<D>& middle,
                                  const Vec<D>& axis, const MovingNodes<D>& nodes) {
  std::vector<Vec<D>> direction;
  if constexpr (D == 3) {
    Vec<3> first = Vec<3>::Unit(std::abs(axis[0]) < 0.7 ? 0 : 1);
    first = (first - first.dot(axis) * axis).normalized();
    const Vec<3> second = cross(axis, first);
    std::vector<std::pair<Real, std::size_t>> order;
    for (std::size_t j = 0; j < ring.size(); ++j) {
      const Vec<3> from = at(nodes.x(), ring[j]) - middle;
      order.emplace_back(std::atan2(second.dot(from), first.dot(from)), j);
    }
    std::sort(order.begin(), order.end());
    const Real pitch = 2 * std::numbers::pi / static_cast<Real>(order.size());
    Real phase = 0;
    for (std::size_t j = 0; j < order.size(); ++j)
      phase += (order[j].first - pitch * static_cast<Real>(j)) / static_cast<Real>(order.size());
    direction.resize(order.size());
    for (std::size_t j = 0; j < order.size(); ++j) {
      const Real angle = phase + pitch * static_cast<Real>(j);
      direction[order[j].second] = std::cos(angle) * first + std::sin(angle) * second;
    }
  } else {
    for (const Index node : ring) {
      const Vec<2> along(-axis[1], axis[0]);
      direction.push_back((at(nodes.x(), node) - middle).dot(along) > 0 ? along : -along);
    }
  }
  return direction;
}

}  // namespace

template <int D>
void hold_at_line(const ContactLine<D>& line, Real time, const Grid<D>& grid,
                  const PresentSurface<D>& surface, MovingNodes<D>& nodes) {
  constexpr Real least_fraction = 0.1;
  constexpr int most_steps = 100;
  const auto gap = [&](const Vec<D>& x) { return line.gap(x, time); };
  const Real wetted = surface.fraction([&](const Vec<D>& x) { return gap(x) < line.level; });
  if (wetted < least_fraction || wetted > 1 - least_fraction) return;
  const std::optional<Vec<D>> found = middle_of_wetted(line, time, grid, nodes);
  if (!found) return;
  Vec<D> middle = *found;
  if (grid.revolved) middle[0] = 0;
  const Index pole = boundary_node_nearest_to<D>(middle, grid, nodes);
  const auto ring = ring_of<D>(wetted, rings_around(pole, grid, nodes), grid);
  if (!ring) return;

  const Real step = 1e-4 * line.level;
  const auto up = [&](const Vec<D>& x) {
    Vec<D> g;
    for (int i = 0; i < D; ++i)
      g[i] = (gap(x + step * Vec<D>::Unit(i)) - gap(x - step * Vec<D>::Unit(i))) / (2 * step);
    return Vec<D>(g.normalized());
  };
  const Vec<D> axis = up(middle);
  const std::vector<Vec<D>> direction = directions_of<D>(*ring, middle, axis, nodes);
  for (std::size_t j = 0; j < ring->size(); ++j) {
    auto foot = nodes.foot((*ring)[j]);
    for (int k = 0; k < most_steps; ++k) {
      const Vec<D> from = foot.x - middle;
      const Real height = from.dot(axis), radius = (from - height * axis).norm();
      Vec<D> p = middle + height * axis + radius * direction[j];
      p += (line.level - gap(p)) * up(p);
      const Vec<D> before = foot.x;
      foot = surface.nearest(p, foot.patch);
      if ((foot.x - before).norm() < 1e-9 * radius) break;
    }
    nodes.hold((*ring)[j], foot);
  }
}

#define MENISCUS_INSTANTIATE(D)                                           \
  template void hold_at_line(const ContactLine<D>&, Real, const Grid<D>&, \
                             const PresentSurface<D>&, MovingNodes<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
