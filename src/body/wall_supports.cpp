// SPDX-License-Identifier: BSD-3-Clause
// Wall supports from the distances of particles to the other side of a cavity.
#include "meniscus/body/wall_supports.hpp"

#include "meniscus/body/surface_points.hpp"
#include "meniscus/core/parallel.hpp"

#include <algorithm>
#include <limits>

namespace meniscus {

namespace {

constexpr Real cosine_of_turn = -0.5;  // 120 degrees
constexpr Real between_points = 0.98;  // places between surface points may be nearer than these
constexpr Real largest_growth = 2.6;   // of supports in ParticleSet::ensure_quality

}  // namespace

template <int D>
WallReport keep_supports_in_wall(ParticleSet<D>& particles, const Geometry<D>& geometry) {
  if (!is_hollow(geometry)) return {};
  const auto inner = surface_points(geometry, 3, SurfacePart::inner);
  const NeighborSearch<D> search(inner.X);
  std::vector<Real> limit(particles.X().size(), std::numeric_limits<Real>::max());
  const std::vector<Real> asked_for(particles.support().begin(), particles.support().end());
  parallel_for(particles.size(), [&](Index A) {
    thread_local std::vector<Index> near;
    const Vec<D>& X = at(particles.X(), A);
    const Vec<D> normal = geometry.director(X);
    search.within_unsorted(X, largest_growth * at(asked_for, A), near);
    for (const Index q : near)
      // Normals of the inner surface point out of the body, into the cavity.
      if (-normal.dot(at(inner.N, q)) < cosine_of_turn)
        at(limit, A) = std::min(at(limit, A), between_points * (X - at(inner.X, q)).norm());
  });
  WallReport report;
  report.shortened = particles.limit_supports(std::move(limit));
  for (Index A = 0; A < particles.size(); ++A)
    report.least_share =
        std::min(report.least_share, at(particles.support(), A) / at(asked_for, A));
  return report;
}

template WallReport keep_supports_in_wall(ParticleSet<2>&, const Geometry<2>&);
template WallReport keep_supports_in_wall(ParticleSet<3>&, const Geometry<3>&);

}  // namespace meniscus
