// SPDX-License-Identifier: BSD-3-Clause
// Quadrature points of the reference surface.
#pragma once
#include "body/shapes/geometry.hpp"

#include <vector>

namespace meniscus {

/// k Gauss points per direction of every boundary facet, 1 <= k <= 20, on the surface of the body.
template <int D>
SurfacePoints<D> surface_points(const Geometry<D>& geometry, int k,
                                SurfacePart part = SurfacePart::whole);

/// The point of the surface at xi in [-1, 1]^(D-1) of a facet. surface_points() gives the same
/// position to a Gauss point xi. On an edge between two patches the point lies on both, and at a
/// node on the axis of revolution it lies there.
template <int D>
Vec<D> surface_point(const Geometry<D>& geometry, const Facet<D>& facet, const Vec<D - 1>& xi);

/// Like surface_points(), on the multilinear facets themselves, for grids without an exact surface.
template <int D>
SurfacePoints<D> facet_points(const Grid<D>& grid, int k);

/// Maps surface points as material points: X' = x, N' = n, grad N' = grad_s n and area' = da (RKPM
/// note 6).
template <int D>
void deform(SurfacePoints<D>& points, const SmoothMap<D>& map);

}  // namespace meniscus
