// SPDX-License-Identifier: BSD-3-Clause
// A grid together with the surface that its boundary facets approximate.
#pragma once
#include "body/surface/mapped_patches.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace meniscus {

/// A body in its reference state.
template <int D>
struct Geometry {
  Grid<D> grid;  ///< boundary found and curved
  std::shared_ptr<const Surface<D>> surface;
  /// Director at a reference position: a unit vector normal to the wall; empty if the shape has
  /// none.
  std::function<Vec<D>(const Vec<D>& X)> director = {};
};

/// Sets the bulges of the grid: boundary edges and facets become quadratic and meet the exact
/// surface in their middles. An edge between two patches meets both. Cells that have only an edge
/// on the boundary get its deviation, too. Deviations below 1e-9 of the length are left out.
template <int D>
void curve_boundary(Geometry<D>& geometry);

/// The body map(unit shape). Only X and cells of `unit` are used. Throws InputError if a boundary
/// facet lies on no patch or a mapped cell folds.
template <int D>
Geometry<D> make_geometry(Grid<D> unit, std::vector<SurfacePatch<D>> patches, bool smooth,
                          SmoothMap<D> map);

/// The body after a further map. Throws InputError if a cell folds.
template <int D>
Geometry<D> apply_map(const SmoothMap<D>& map, Geometry<D> geometry);

}  // namespace meniscus
