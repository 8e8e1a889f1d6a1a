// SPDX-License-Identifier: BSD-3-Clause
// A grid together with the exact surface that its boundary facets approximate.
#pragma once
#include "meniscus/body/grid.hpp"
#include "meniscus/body/smooth_map.hpp"

#include <functional>
#include <vector>

namespace meniscus {

/// A piece of the surface of a unit shape: plane (2D: line) or round (sphere, cylinder, circle).
template <int D>
struct SurfacePatch {
  /// Projection of a point onto the patch, with the derivative of the projection.
  struct Foot {
    Vec<D> X, N;        ///< nearest point of the patch, outward unit normal there
    Mat<D> grad_N;      ///< N_K,L along the surface
    Mat<D> derivative;  ///< dX_foot / dX
  };

  static SurfacePatch plane(const Vec<D>& point, const Vec<D>& normal);
  static SurfacePatch sphere(const Vec<D>& centre, Real radius);  ///< in 2D a circle
  static SurfacePatch cavity(const Vec<D>& centre, Real radius);  ///< the normal points inwards
  /// About the line through `point` along the unit vector `axis`.
  static SurfacePatch cylinder(const Vec<D>& point, const Vec<D>& axis, Real radius);

  Foot project(const Vec<D>& X) const;
  Real distance(const Vec<D>& X) const { return (project(X).X - X).norm(); }
  bool inner() const { return radius < 0; }

  Vec<D> origin = Vec<D>::Zero();
  /// Orthogonal projection onto the directions in which the patch is round; zero for a plane.
  Mat<D> round = Mat<D>::Zero();
  Vec<D> normal = Vec<D>::Zero();  ///< of a plane
  Real radius = 0;                 ///< of a round patch; negative: the body is around it
};

/// A body in its reference state: grid, and surface = map(patches of a unit shape).
template <int D>
struct Geometry {
  Grid<D> grid;                          ///< boundary found and curved, patches assigned
  std::vector<Vec<D>> unit_X;            ///< node positions before the map (boundary nodes: exact)
  std::vector<SurfacePatch<D>> patches;  ///< surface of the unit shape
  SmoothMap<D> map;                      ///< unit shape -> body
  /// No edges or corners: the normal is continuous (the curvature form of tension needs it).
  bool smooth = false;
  /// Of the reference position: unit, along the wall's normal; empty if the shape has none.
  std::function<Vec<D>(const Vec<D>& X)> director = {};
};

/// Sets the bulges of the grid: edges and facets of the boundary become quadratic and meet the
/// exact surface in their middles, those between two patches on both. Cells that share only an edge
/// with the boundary follow it. What deviates by less than 1e-9 of its length is straight.
template <int D>
void curve_boundary(Geometry<D>& geometry);

/// The body map(unit shape). `unit` needs X and cells only.
/// Throws InputError if a boundary facet lies on none of the patches or a mapped cell folds.
template <int D>
Geometry<D> make_geometry(Grid<D> unit, std::vector<SurfacePatch<D>> patches, bool smooth,
                          SmoothMap<D> map);

/// The body after a further map; throws InputError if a cell folds.
template <int D>
Geometry<D> apply_map(const SmoothMap<D>& map, Geometry<D> geometry);

}  // namespace meniscus
