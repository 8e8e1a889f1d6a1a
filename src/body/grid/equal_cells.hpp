// SPDX-License-Identifier: BSD-3-Clause
// Finds equal parallelepipeds among the cells: their samples are exact without corrections.
#pragma once
#include "body/grid/grid.hpp"

#include <vector>

namespace meniscus {

/// [cell] the same number for cells that are translations of one parallelepiped (2D:
/// parallelogram), to 1e-13 of its edges, with corners in the same order; -1 for other cells. A
/// cell is only compared with the last one that differed, so equal cells further on may have
/// another number.
template <int D>
std::vector<Index> equal_cells(const Grid<D>& grid);

}  // namespace meniscus
