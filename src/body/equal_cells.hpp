// SPDX-License-Identifier: BSD-3-Clause
// Cells of a grid that are equal parallelepipeds: what their samples miss need not be computed.
#pragma once
#include "meniscus/body/grid.hpp"

#include <vector>

namespace meniscus {

/// [cell] the same number for cells that are the same parallelepiped (2D: parallelogram) but for
/// their place, to 1e-13 of its edges, and whose corners are numbered alike; -1 for cells that are
/// none. Cells are compared with the one that differed last: equal ones further on may have another
/// number.
template <int D>
std::vector<Index> equal_cells(const Grid<D>& grid);

}  // namespace meniscus
