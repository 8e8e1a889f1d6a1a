// SPDX-License-Identifier: BSD-3-Clause
// Checks that the cells of a mesh fill a body exactly once.
#pragma once
#include "body/grid/grid.hpp"

#include <functional>
#include <string>

namespace meniscus {

/// Throws InputError unless the straight cells of the grid are joined by whole sides and do not
/// overlap. A side may belong to at most two cells, on either side of it. The cells around a node
/// must be joined by sides, not only by an edge or a corner. No cell may contain a node or the
/// middle of another cell, no edge of the surface may pierce a facet, and all cells must form one
/// connected part. `name(e)` begins the
/// messages about cell e, e.g. "line 21: element 3".
template <int D>
void require_simple_body(const Grid<D>& grid, const std::function<std::string(Index)>& name);

}  // namespace meniscus
