// SPDX-License-Identifier: BSD-3-Clause
// Quadrature points of the reference surface.
#pragma once
#include "meniscus/body/geometry.hpp"

#include <vector>

namespace meniscus {

/// Which part of the surface of a hollow body; a solid one is outer altogether.
enum class SurfacePart { whole, outer, inner };

/// Structure of arrays over the points, facet after facet; those of the i-th of the facets asked
/// for stand at [i * per_facet, (i + 1) * per_facet).
template <int D>
struct SurfacePoints {
  std::vector<Vec<D>> X;       ///< position
  std::vector<Vec<D>> N;       ///< outward unit normal
  std::vector<Mat<D>> grad_N;  ///< N_K,L, tangential in both indices: grad_N N = grad_N^T N = 0
  std::vector<Real> area;      ///< weight; in 2D length per unit depth
  std::vector<Index> facet;    ///< number of the boundary facet
  int per_facet = 0;
  /// On the exact surface. Otherwise flat facets with grad_N = 0: no curvature can be had from it.
  bool exact = false;

  Index size() const { return static_cast<Index>(X.size()); }
};

/// k Gauss points per direction of every boundary facet, 1 <= k <= 20, on the exact surface: facet
/// points projected onto their patch of the unit shape with exact tangents, then mapped.
template <int D>
SurfacePoints<D> surface_points(const Geometry<D>& geometry, int k,
                                SurfacePart part = SurfacePart::whole);

/// The point of the exact surface at xi in [-1, 1]^(D-1) of a facet: where surface_points() puts a
/// Gauss point xi. On an edge between two patches it lies on both.
template <int D>
Vec<D> surface_point(const Geometry<D>& geometry, const Facet<D>& facet, const Vec<D - 1>& xi);

/// The same as surface_points() on the multilinear facets themselves, for grids without an exact
/// surface.
template <int D>
SurfacePoints<D> facet_points(const Grid<D>& grid, int k);

/// Surface points are material points. Those of the surface deformed by a map are X' = x, N' = n,
/// grad N' = grad_s n and area' = da (RKPM note 6).
template <int D>
void deform(SurfacePoints<D>& points, const SmoothMap<D>& map);

}  // namespace meniscus
