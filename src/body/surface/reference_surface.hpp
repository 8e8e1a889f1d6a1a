// SPDX-License-Identifier: BSD-3-Clause
// The reference surface of a body, which the boundary facets of its grid approximate. It is given
// by patches of a shape (mapped_patches.hpp) or by the facets alone (recovered_surface.hpp).
#pragma once
#include "body/grid/grid.hpp"
#include "body/shapes/smooth_map.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// A part of the surface of a hollow body. The surface of a solid body is all outer.
enum class SurfacePart { whole, outer, inner };

/// Points of a surface, facet after facet. The i-th of the requested facets has the points [i *
/// per_facet, (i + 1) * per_facet).
template <int D>
struct SurfacePoints {
  std::vector<Vec<D>> X;       ///< position
  std::vector<Vec<D>> N;       ///< outward unit normal
  std::vector<Mat<D>> grad_N;  ///< N_K,L, tangential in both indices: grad_N N = grad_N^T N = 0
  std::vector<Real> area;      ///< weight; in 2D length per unit depth, or area of revolution
  std::vector<Index> facet;    ///< number of the boundary facet
  int per_facet = 0;
  /// True for points on the exact surface. Otherwise facets are flat with grad_N = 0, so the points
  /// have no curvature.
  bool exact = false;

  Index size() const { return static_cast<Index>(X.size()); }
};

/// The surface of a body. Objects never change: a change of the body makes a new one. The grid that
/// functions take is always the grid of the body.
template <int D>
class Surface {
 public:
  virtual ~Surface() = default;

  /// k Gauss points per direction of every boundary facet of the part. Areas are without circles;
  /// surface_points() has them.
  virtual SurfacePoints<D> points(const Grid<D>& grid, int k, SurfacePart part) const = 0;
  /// The point of the surface at xi in [-1, 1]^(D-1) of a facet, which is the place that points()
  /// gives to a Gauss point xi. All facets that share the point return the same one.
  virtual Vec<D> point(const Grid<D>& grid, const Facet<D>& facet, const Vec<D - 1>& xi) const = 0;

  /// True if there are no edges or corners. The normal is then continuous, which the curvature form
  /// of surface tension needs.
  virtual bool smooth() const = 0;
  /// True if a part of the surface is inner.
  virtual bool hollow() const = 0;
  /// The name of the face that a patch belongs to, or empty.
  virtual std::string face_name(int) const { return {}; }

  /// The surface after renumbering: node i of the new body is node order[i] of this one.
  virtual std::shared_ptr<const Surface> renumbered(std::span<const Index> order) const = 0;
  /// The surface of the body after a map; `grid` is the mapped grid.
  virtual std::shared_ptr<const Surface> mapped(const SmoothMap<D>& map,
                                                const Grid<D>& grid) const = 0;
};

}  // namespace meniscus
