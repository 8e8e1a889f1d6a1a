// SPDX-License-Identifier: BSD-3-Clause
// Slab-and-Morton order, and renumbering of grids.
#include "meniscus/body/ordering.hpp"

#include "meniscus/core/box.hpp"
#include "meniscus/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace meniscus {

namespace {

/// Bits of a and b alternate in the result (those of a lower).
std::uint64_t interleave(std::uint32_t a, std::uint32_t b) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < 32; ++bit)
    code |= (std::uint64_t((a >> bit) & 1) << (2 * bit)) |
            (std::uint64_t((b >> bit) & 1) << (2 * bit + 1));
  return code;
}

template <class T>
std::vector<T> permuted(const std::vector<T>& values, std::span<const Index> order) {
  std::vector<T> result;
  result.reserve(values.size());
  for (const Index old : order) result.push_back(at(values, old));
  return result;
}

/// new number of every old one
std::vector<Index> inverse_order(std::span<const Index> order) {
  std::vector<Index> number(order.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Index old = order[i];
    if (old < 0 || old >= static_cast<Index>(order.size()) || at(number, old) >= 0)
      throw InputError("the new order of the nodes is not a permutation of their numbers");
    at(number, old) = static_cast<Index>(i);
  }
  return number;
}

}  // namespace

template <int D>
std::vector<Index> spatial_order(std::span<const Vec<D>> points, Real spacing) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  if (points.empty()) return order;
  const Box<D> box = box_around<D>(points);
  int axis = 0;
  const Vec<D> extent = box.extent();
  extent.maxCoeff(&axis);

  // Morton codes of 24 bits per direction, in units of the longest extent.
  const Real scale = extent[axis] > 0 ? Real((1 << 24) - 1) / extent[axis] : 0;
  struct Key {
    std::int64_t slab;
    std::uint64_t code;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  for (const auto& X : points) {
    const auto level = [&](int k) {
      return static_cast<std::uint32_t>(scale * (X[k] - box.low[k]));
    };
    // Half a spacing of shift keeps layers of a lattice away from slab borders.
    const Real slab = std::floor((X[axis] - box.low[axis]) / spacing + 0.5);
    keys.push_back({static_cast<std::int64_t>(slab),
                    interleave(level((axis + 1) % D), D == 3 ? level((axis + 2) % D) : 0u)});
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return at(keys, a) < at(keys, b); });
  return order;
}

template <int D>
void renumber(Grid<D>& grid, std::span<const Index> order) {
  if (order.size() != grid.X.size())
    throw InputError("the new order of the nodes is not a permutation of their numbers");
  const std::vector<Index> number = inverse_order(order);
  grid.X = permuted(grid.X, order);
  for (auto& cell : grid.cells)
    for (Index& node : cell) node = at(number, node);
  for (auto& facet : grid.facets)
    for (Index& node : facet.nodes) node = at(number, node);

  std::vector<Index> cell_order(grid.cells.size());
  std::iota(cell_order.begin(), cell_order.end(), 0);
  const auto lowest = [&](Index e) {
    return *std::min_element(at(grid.cells, e).begin(), at(grid.cells, e).end());
  };
  std::stable_sort(cell_order.begin(), cell_order.end(),
                   [&](Index a, Index b) { return lowest(a) < lowest(b); });
  grid.cells = permuted(grid.cells, cell_order);
  if (!grid.bulge_of.empty()) grid.bulge_of = permuted(grid.bulge_of, cell_order);
  const std::vector<Index> cell_number = inverse_order(cell_order);
  for (auto& facet : grid.facets) facet.cell = at(cell_number, facet.cell);
  std::sort(grid.facets.begin(), grid.facets.end(), [](const Facet<D>& a, const Facet<D>& b) {
    return std::pair(a.cell, a.side) < std::pair(b.cell, b.side);
  });
}

template <int D>
void renumber(Geometry<D>& geometry, std::span<const Index> order) {
  renumber(geometry.grid, order);
  geometry.surface = geometry.surface->renumbered(order);
}

template <int D>
std::vector<Index> order_spatially(Geometry<D>& geometry) {
  const Real spacing =
      std::pow(volume(geometry.grid) / static_cast<Real>(geometry.grid.X.size()), 1.0 / D);
  std::vector<Index> order = spatial_order<D>(geometry.grid.X, spacing);
  renumber<D>(geometry, order);
  return order;
}

#define MENISCUS_INSTANTIATE(D)                                                \
  template std::vector<Index> spatial_order<D>(std::span<const Vec<D>>, Real); \
  template void renumber<D>(Grid<D>&, std::span<const Index>);                 \
  template void renumber<D>(Geometry<D>&, std::span<const Index>);             \
  template std::vector<Index> order_spatially<D>(Geometry<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
