// SPDX-License-Identifier: BSD-3-Clause
// Facets of meshes that could not be curved.
#pragma once
#include "body/shapes/geometry.hpp"

namespace meniscus {

/// The number of facets of a mesh that have a straight edge where the surface is curved, because a
/// cell would fold otherwise. 0 for bodies of other shapes.
template <int D>
Index straightened_facets(const Geometry<D>& geometry);

}  // namespace meniscus
