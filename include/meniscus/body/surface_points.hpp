// SPDX-License-Identifier: BSD-3-Clause
// Quadrature points of the reference surface.
#pragma once
#include "meniscus/body/geometry.hpp"

#include <vector>

namespace meniscus {

/// Structure of arrays over the points; those of facet f stand at [f * per_facet, (f+1) *
/// per_facet).
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
SurfacePoints<D> surface_points(const Geometry<D>& geometry, int k);

/// The same on the multilinear facets themselves, for grids without an exact surface.
template <int D>
SurfacePoints<D> facet_points(const Grid<D>& grid, int k);

/// Surface points are material points. Those of the surface carried by a map are X' = x, N' = n,
/// grad N' = grad_s n and area' = da (RKPM note 6).
template <int D>
void carry(SurfacePoints<D>& points, const SmoothMap<D>& map);

/// Volume (2D: area) inside the exact surface, by the divergence theorem.
template <int D>
Real enclosed_volume(const Geometry<D>& geometry);

/// Moves the nodes away from the centre, all by the same factor, until the cells enclose the volume
/// of the exact surface. Straight cells inside a convex surface are short of volume and mass by
/// O(h^2) (1.1 % for a ball of 4341 particles), and the pressure of a drop, 2 gamma A / (3 V),
/// would be wrong as much. Surface points stay on the exact surface.
template <int D>
void match_volume(Geometry<D>& geometry);

}  // namespace meniscus
