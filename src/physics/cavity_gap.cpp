// SPDX-License-Identifier: BSD-3-Clause
// Cavity gap: pairs of opposite places.
#include "meniscus/physics/cavity_gap.hpp"

#include <cmath>
#include <limits>

namespace meniscus {

namespace {

/// The point that the normal of point q meets: of those that face it the one nearest to the line,
/// -1 if the line passes more than a facet beside it.
template <int D>
Index opposite(const SurfacePoints<D>& surface, Index q, const std::vector<Index>& candidates) {
  Index found = -1;
  Real nearest = std::pow(at(surface.area, q) * surface.per_facet, 2.0 / (D - 1));
  for (const Index r : candidates) {
    if (at(surface.N, q).dot(at(surface.N, r)) > -0.5) continue;
    const Vec<D> way = at(surface.X, r) - at(surface.X, q);
    const Real along = way.dot(at(surface.N, q)), beside = way.squaredNorm() - along * along;
    if (along <= 0 || beside >= nearest) continue;
    nearest = beside;
    found = r;
  }
  return found;
}

}  // namespace

template <int D>
CavityGap<D>::CavityGap(const SurfacePoints<D>& reference) {
  std::vector<Index> one_per_facet;
  for (Index q = reference.per_facet / 2; q < reference.size(); q += reference.per_facet)
    one_per_facet.push_back(q);
  std::vector<Index> beyond(one_per_facet.size());
  parallel_for(static_cast<Index>(one_per_facet.size()), [&](Index k) {
    at(beyond, k) = opposite(reference, at(one_per_facet, k), one_per_facet);
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
