// SPDX-License-Identifier: BSD-3-Clause
// Sharp edges of the present surface, such as the rim of the flat face of a drop that began as a
// half disk.
#pragma once
#include "remap/present_surface.hpp"

#include <vector>

namespace meniscus {

/// Boundary nodes at which facets meet at more than 45 degrees, ascending.
template <int D>
std::vector<Index> nodes_on_edges(const Grid<D>& grid, const PresentSurface<D>& surface);

}  // namespace meniscus
