// SPDX-License-Identifier: BSD-3-Clause
// Spatial order of particles: neighbours in space become neighbours in memory.
#pragma once
#include "meniscus/body/geometry.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace meniscus {

/// The numbers of the points in spatial order (order[new] = old): the cloud is cut across its
/// longest edge into two halves, these likewise, and so on; those that are cut first begin where
/// chunks of the points begin (core/parallel), which so are blocks: their rows touch few particles
/// of others. Equal places keep their order.
template <int D>
std::vector<Index> spatial_order(std::span<const Vec<D>> points);

/// A sum of places with weights of their numbers, which tells orders of the same points apart: to
/// exchange two changes it by some of their distance, rounding of places by no more than theirs.
template <int D>
Vec<D> mark_of_order(std::span<const Vec<D>> points);

/// The corner of a cell with the lowest number.
template <class Cell>
Index lowest_node(const Cell& cell) {
  return *std::min_element(cell.begin(), cell.end());
}

/// Gives node order[i] the number i. Cells are then sorted by their lowest node and facets by cell.
/// `order` must be a permutation of the nodes, else InputError.
template <int D>
void renumber(Grid<D>& grid, std::span<const Index> order);
template <int D>
void renumber(Geometry<D>& geometry, std::span<const Index> order);

/// Renumbers in spatial order; returns order.
template <int D>
std::vector<Index> order_spatially(Geometry<D>& geometry);

}  // namespace meniscus
