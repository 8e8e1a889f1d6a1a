// SPDX-License-Identifier: BSD-3-Clause
// Supports of hollow bodies from the distances of particles to the other side of the cavity.
#include "body/wall_supports.hpp"

#include "body/surface/surface_points.hpp"
#include "meniscus/error.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <limits>

namespace meniscus {

namespace {

constexpr Real cosine_of_turn = -0.5;  // cosine of 120 degrees
constexpr Real between_points = 0.98;  // the surface may be nearer than its sampled points
constexpr Real largest_growth = 2.6;   // growth of supports in ParticleSet::ensure_quality

/// The image of a vector on the other side of the axis x = 0.
template <int D>
Vec<D> beyond_axis(Vec<D> x) {
  x[0] = -x[0];
  return x;
}

/// The points of a surface grouped by facets, so that most facets are skipped as a whole.
template <int D>
class PointsOfFacets {
 public:
  explicit PointsOfFacets(const SurfacePoints<D>& points)
      : points_(points), facets_(facets_of(points)), search_(middles_of(facets_)) {
    for (const Facet& facet : facets_) largest_ = std::max(largest_, facet.radius);
  }

  /// Calls f(distance from X) for the points within `radius` whose normal N has -normal.N < cosine.
  /// May also call it for points beyond `radius`.
  void for_turned(const Vec<D>& X, const Vec<D>& normal, Real cosine, Real radius, auto&& f) const {
    thread_local std::vector<Index> near;
    search_.within_unsorted(X, radius + largest_, near);
    for (const Index i : near) {
      const Facet& facet = at(facets_, i);
      if (-normal.dot(facet.normal) - facet.turn >= cosine) continue;
      for (Index q = facet.begin; q < facet.begin + points_.per_facet; ++q)
        // Normals of the inner surface point out of the body, into the cavity.
        if (-normal.dot(at(points_.N, q)) < cosine) f((X - at(points_.X, q)).norm());
    }
  }

 private:
  struct Facet {
    Index begin;
    Vec<D> middle = Vec<D>::Zero(), normal = Vec<D>::Zero();  // means over the points of the facet
    Real radius = 0, turn = 0;                                // largest deviations from these means
  };
  static std::vector<Facet> facets_of(const SurfacePoints<D>& points) {
    std::vector<Facet> facets;
    const Index count = points.per_facet;
    for (Index begin = 0; begin < points.size(); begin += count) {
      Facet& facet = facets.emplace_back(Facet{begin});
      for (Index q = begin; q < begin + count; ++q) {
        facet.middle += at(points.X, q) / count;
        facet.normal += at(points.N, q) / count;
      }
      for (Index q = begin; q < begin + count; ++q) {
        facet.radius = std::max(facet.radius, (at(points.X, q) - facet.middle).norm());
        facet.turn = std::max(facet.turn, (at(points.N, q) - facet.normal).norm());
      }
      facet.radius *= 1 + 1e-12;
      facet.turn += 1e-12;
    }
    return facets;
  }
  static std::vector<Vec<D>> middles_of(const std::vector<Facet>& facets) {
    std::vector<Vec<D>> middles;
    for (const Facet& facet : facets) middles.push_back(facet.middle);
    return middles;
  }

  const SurfacePoints<D>& points_;
  std::vector<Facet> facets_;
  NeighborSearch<D> search_;
  Real largest_ = 0;
};

}  // namespace

template <int D>
WallReport keep_supports_in_wall(ParticleSet<D>& particles, const Geometry<D>& geometry) {
  if (!is_hollow(geometry)) return {};
  if (!geometry.director)
    throw InputError(
        "the shape has a cavity, but no normal to its walls (Geometry::director), by which "
        "supports are "
        "kept within them");
  const auto inner = surface_points(geometry, 3, SurfacePart::inner);
  const PointsOfFacets<D> surface(inner);
  std::vector<Real> limit(particles.X().size(), std::numeric_limits<Real>::max());
  const std::vector<Real> asked_for(particles.support().begin(), particles.support().end());
  parallel_for(particles.size(), [&](Index A) {
    const Vec<D>& X = at(particles.X(), A);
    const Real radius = largest_growth * at(asked_for, A);
    const Vec<D> normal = geometry.director(X);
    const auto keep = [&](Real distance) {
      if (distance <= radius) at(limit, A) = std::min(at(limit, A), between_points * distance);
    };
    surface.for_turned(X, normal, cosine_of_turn, radius, keep);
    if (geometry.grid.revolved)  // the wall on the other side of the axis
      surface.for_turned(beyond_axis<D>(X), beyond_axis<D>(normal), cosine_of_turn, radius, keep);
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
