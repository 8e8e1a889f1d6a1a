// SPDX-License-Identifier: BSD-3-Clause
// Spatial order of particles: near particles get near numbers.
#pragma once
#include "body/shapes/geometry.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace meniscus {

/// The numbers of the points in spatial order (order[new] = old). The cloud is halved across its
/// longest edge, then each half likewise. The first cuts are at the begins of chunks
/// (parallel/parallel), so that chunks are compact blocks whose rows touch few particles of other
/// chunks. Points at the same place keep their order.
template <int D>
std::vector<Index> spatial_order(std::span<const Vec<D>> points);

/// A weighted sum of positions that identifies the order of the points. Swapping two points changes
/// it by a part of their distance; rounding of positions changes it by no more than the rounding.
template <int D>
Vec<D> mark_of_order(std::span<const Vec<D>> points);

/// The corner of a cell with the lowest number.
template <class Cell>
Index lowest_node(const Cell& cell) {
  return *std::min_element(cell.begin(), cell.end());
}

/// Renumbers the nodes: node order[i] becomes node i. Then cells are sorted by their lowest node
/// and facets by cell. Throws InputError if `order` is no permutation of the nodes.
template <int D>
void renumber(Grid<D>& grid, std::span<const Index> order);
template <int D>
void renumber(Geometry<D>& geometry, std::span<const Index> order);

/// Renumbers a body in spatial order and returns the order.
template <int D>
std::vector<Index> order_spatially(Geometry<D>& geometry);

}  // namespace meniscus
