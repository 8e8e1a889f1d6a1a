// SPDX-License-Identifier: BSD-3-Clause
// Order in which sparse factors of a body's grid stay small.
#pragma once
#include "body/grid/grid.hpp"

#include <vector>

namespace meniscus {

/// The nodes of a grid (order[new] = old): those of one half, those of the other, and last those of
/// the first half that share a cell with the second; the halves likewise. Halves are cut across the
/// longest extent of their nodes (George, SIAM J. Numer. Anal. 10 (1973) 345, by places instead of
/// the numbers of a square grid). Depends on nothing but the grid.
template <int D>
std::vector<Index> nested_dissection(const Grid<D>& grid);

}  // namespace meniscus
