// SPDX-License-Identifier: BSD-3-Clause
// Where a surface law acts: Gauss points of all facets of a body, or of one face.
#pragma once
#include "body/body.hpp"
#include "body/surface/surface_points.hpp"

#include <string>
#include <utility>

namespace meniscus {

struct SurfaceSites {
  int points;        ///< Gauss points per direction of every facet
  std::string face;  ///< name of a face of the shape; empty: the whole surface

  SurfaceSites(int per_direction, std::string of_face = {})
      : points(per_direction), face(std::move(of_face)) {}
};

/// The points of the reference surface at `sites`.
template <int D>
SurfacePoints<D> points_at(const Body<D>& body, const SurfaceSites& sites) {
  const SurfacePoints<D> all = surface_points(body.geometry, sites.points);
  if (sites.face.empty()) return all;
  SurfacePoints<D> some;
  some.per_facet = all.per_facet;
  some.exact = all.exact;
  for (Index q = 0; q < all.size(); ++q) {
    const Facet<D>& facet = at(body.geometry.grid.facets, at(all.facet, q));
    if (body.geometry.surface->face_name(facet.patch) != sites.face) continue;
    some.X.push_back(at(all.X, q));
    some.N.push_back(at(all.N, q));
    some.grad_N.push_back(at(all.grad_N, q));
    some.area.push_back(at(all.area, q));
    some.facet.push_back(at(all.facet, q));
  }
  return some;
}

}  // namespace meniscus
