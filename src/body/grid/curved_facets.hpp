// SPDX-License-Identifier: BSD-3-Clause
// How a mesh with straight facets was curved.
#pragma once
#include "body/shapes/geometry.hpp"

namespace meniscus {

/// Facets of a mesh of first order, whose surface is curved between its nodes.
struct CurvedFacets {
  /// Facets that have a straight edge, because a cell would fold otherwise.
  Index straightened = 0;
  /// Volume that curving adds, as a share of the volume with straight facets.
  Real added_volume = 0;
};

/// The facets of a mesh of first order; zeros for meshes of second order and for other shapes.
template <int D>
CurvedFacets curved_facets(const Geometry<D>& geometry);

}  // namespace meniscus
