// SPDX-License-Identifier: BSD-3-Clause
// Spatial order of particles: neighbours in space become neighbours in memory.
#pragma once
#include "meniscus/body/geometry.hpp"

#include <span>
#include <vector>

namespace meniscus {

/// The numbers of the points in spatial order (order[new] = old): slabs of thickness `spacing`
/// along the longest axis of the cloud, Morton order inside a slab; equal places keep their order.
/// Slabs keep the rows that touch one particle close together (narrow windows of the force
/// reduction).
template <int D>
std::vector<Index> spatial_order(std::span<const Vec<D>> points, Real spacing);

/// Gives node order[i] the number i. Cells are then sorted by their lowest node and facets by cell.
/// `order` must be a permutation of the nodes, else InputError.
template <int D>
void renumber(Grid<D>& grid, std::span<const Index> order);
template <int D>
void renumber(Geometry<D>& geometry, std::span<const Index> order);

/// Renumbers in spatial order with slabs of the mean spacing (V / nodes)^(1/D); returns order.
template <int D>
std::vector<Index> order_spatially(Geometry<D>& geometry);

}  // namespace meniscus
