// SPDX-License-Identifier: BSD-3-Clause
// A grid together with the surface that its boundary facets approximate.
#pragma once
#include "meniscus/body/mapped_patches.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace meniscus {

/// A body in its reference state.
template <int D>
struct Geometry {
  Grid<D> grid;  ///< boundary found and curved
  std::shared_ptr<const Surface<D>> surface;
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
