// SPDX-License-Identifier: BSD-3-Clause
// An ordering of the nodes of a grid for which sparse factors stay small.
#pragma once
#include "body/grid/grid.hpp"

#include <vector>

namespace meniscus {

/// Nested dissection of the nodes of a grid, order[new] = old (George, SIAM J. Numer. Anal. 10
/// (1973) 345, by positions instead of the numbers of a square grid). The nodes are cut in half
/// across their longest extent. The order is: first half, second half, and last the nodes of the
/// first half that share a cell with the second half. Each half is ordered in the same way. The
/// order depends on the grid only.
template <int D>
std::vector<Index> nested_dissection(const Grid<D>& grid);

}  // namespace meniscus
