// SPDX-License-Identifier: BSD-3-Clause
// The reference surface of a body, which the boundary facets of its grid approximate, whatever it
// is known by: patches of a shape (mapped_patches.hpp) or the facets alone (recovered_surface.hpp).
#pragma once
#include "meniscus/body/grid.hpp"
#include "meniscus/body/smooth_map.hpp"

#include <memory>
#include <span>
#include <string>
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

/// Never changes; what is done to a body makes another one. The grid handed in is always that of
/// the body.
template <int D>
class Surface {
 public:
  virtual ~Surface() = default;

  /// k Gauss points per direction of every boundary facet of that part.
  virtual SurfacePoints<D> points(const Grid<D>& grid, int k, SurfacePart part) const = 0;
  /// The point of the surface at xi in [-1, 1]^(D-1) of a facet: where points() has a Gauss point
  /// xi. The same for all facets that share it.
  virtual Vec<D> point(const Grid<D>& grid, const Facet<D>& facet, const Vec<D - 1>& xi) const = 0;

  /// No edges or corners: the normal is continuous (the curvature form of tension needs it).
  virtual bool smooth() const = 0;
  /// Whether a part of it is an inner one.
  virtual bool hollow() const = 0;
  /// Name of the face that a patch is part of; empty: it has none.
  virtual std::string face_name(int) const { return {}; }

  /// That of the body whose node i is the node order[i] of this one.
  virtual std::shared_ptr<const Surface> renumbered(std::span<const Index> order) const = 0;
  /// That of the body after a map, with its grid.
  virtual std::shared_ptr<const Surface> mapped(const SmoothMap<D>& map,
                                                const Grid<D>& grid) const = 0;
};

}  // namespace meniscus
