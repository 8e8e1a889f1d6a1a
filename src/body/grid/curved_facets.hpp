// SPDX-License-Identifier: BSD-3-Clause
// What was made of the straight facets of a mesh.
#pragma once
#include "body/shapes/geometry.hpp"

namespace meniscus {

/// Facets of a mesh of first order, whose surface is curved between its nodes.
struct CurvedFacets {
  Index straightened =
      0;  ///< facets that have a straight edge, because a cell would fold otherwise
  Real added_volume =
      0;  ///< volume that curving adds, as a share of the volume with straight facets
};

/// What curving did to the facets of a mesh; nothing for meshes of second order and other shapes.
template <int D>
CurvedFacets curved_facets(const Geometry<D>& geometry);

}  // namespace meniscus
