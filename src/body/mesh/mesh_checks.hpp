// SPDX-License-Identifier: BSD-3-Clause
// Whether the cells of a mesh fill a body once.
#pragma once
#include "body/grid/grid.hpp"

#include <functional>
#include <string>

namespace meniscus {

/// Throws InputError unless the straight cells of the grid are joined by whole sides and do not
/// overlap: a side has one cell on either side of it; the cells around a node are joined by sides
/// there, not by an edge or a corner only; no cell has a node or the middle of another cell inside;
/// and no edge of the surface goes through a facet of it. `name(e)` begins the messages about cell
/// e, e.g. "line 21: element 3".
template <int D>
void require_simple_body(const Grid<D>& grid, const std::function<std::string(Index)>& name);

}  // namespace meniscus
