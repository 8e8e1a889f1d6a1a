// SPDX-License-Identifier: BSD-3-Clause
// The gap of a cavity, from pairs of opposite surface points.
#include "physics/loads/cavity_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace meniscus {

namespace {

/// Consecutive points, which are usually near each other, and a ball around them.
template <int D>
struct Cluster {
  std::span<const Index> points;
  Vec<D> centre = Vec<D>::Zero();
  Real radius = 0;
};

template <int D>
std::vector<Cluster<D>> clusters_of(const SurfacePoints<D>& surface,
                                    std::span<const Index> points) {
  constexpr std::size_t most = 32;
  std::vector<Cluster<D>> clusters;
  for (; !points.empty(); points = points.subspan(clusters.back().points.size())) {
    Cluster<D>& cluster = clusters.emplace_back();
    cluster.points = points.first(std::min(most, points.size()));
    for (const Index q : cluster.points)
      cluster.centre += at(surface.X, q) / static_cast<Real>(cluster.points.size());
    for (const Index q : cluster.points)
      cluster.radius = std::max(cluster.radius, (at(surface.X, q) - cluster.centre).norm());
  }
  return clusters;
}

/// The point that lies opposite to point q: of the points that face q, the one nearest to the line
/// along the normal of q, which has this area in the grid. -1 if no point is nearer to this line
/// than the size of a facet.
template <int D>
Index opposite(const SurfacePoints<D>& surface, Index q, Real area,
               const std::vector<Cluster<D>>& candidates) {
  Index found = -1;
  Real nearest = std::pow(area * surface.per_facet, 2.0 / (D - 1));
  const Vec<D>&X = at(surface.X, q), &N = at(surface.N, q);
  for (const Cluster<D>& cluster : candidates) {
    const Vec<D> to_centre = cluster.centre - X;
    const Real off_line = (to_centre - to_centre.dot(N) * N).norm();
    if (off_line > (std::sqrt(nearest) + cluster.radius) * (1 + 1e-9)) continue;
    for (const Index r : cluster.points) {
      if (N.dot(at(surface.N, r)) > -0.5) continue;
      const Vec<D> way = at(surface.X, r) - X;
      const Real along = way.dot(N), beside = way.squaredNorm() - along * along;
      if (along <= 0 || beside >= nearest) continue;
      nearest = beside;
      found = r;
    }
  }
  return found;
}

}  // namespace

template <int D>
CavityGap<D>::CavityGap(const Body<D>& of, const SurfacePoints<D>& reference) {
  std::vector<Index> one_per_facet;
  for (Index q = reference.per_facet / 2; q < reference.size(); q += reference.per_facet)
    one_per_facet.push_back(q);
  const std::vector<Cluster<D>> clusters = clusters_of(reference, one_per_facet);
  std::vector<Index> beyond(one_per_facet.size());
  parallel_for(static_cast<Index>(one_per_facet.size()), [&](Index k) {
    const Index q = at(one_per_facet, k);
    const Real length = circle(of.geometry.grid, at(reference.X, q));
    at(beyond, k) = opposite(reference, q, at(reference.area, q) / length, clusters);
  });
  for (std::size_t k = 0; k < beyond.size(); ++k)
    if (beyond[k] >= 0) pairs_.push_back({one_per_facet[k], beyond[k]});
}

template <int D>
typename CavityGap<D>::Gap CavityGap<D>::smallest(
    const typename ClosedSurface<D>::Placed& surface) const {
  Gap gap{std::numeric_limits<Real>::infinity(), -1};
  for (const Pair& pair : pairs_) {
    const Vec<D> n = surface.area_vector(pair.point).normalized();
    const Real width = n.dot(surface.place(pair.opposite) - surface.place(pair.point));
    if (width < gap.width) gap = {width, pair.point};
  }
  return gap;
}

template class CavityGap<2>;
template class CavityGap<3>;

}  // namespace meniscus
