// SPDX-License-Identifier: BSD-3-Clause
// Spatial order by repeated halving, and renumbering of grids.
#include "body/grid/ordering.hpp"

#include "meniscus/error.hpp"
#include "numbers/box.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace meniscus {

namespace {

/// Coordinates rounded to fine steps: points of one layer of a lattice get the same coordinate,
/// despite rounding errors.
template <int D>
using Levels = std::array<std::int32_t, D>;

template <int D>
std::vector<Levels<D>> levels_of(std::span<const Vec<D>> points) {
  constexpr Real steps = 1 << 20;
  const Box<D> box = box_around<D>(points);
  const Real longest = box.extent().maxCoeff();
  const Real scale = longest > 0 ? steps / longest : 0;
  std::vector<Levels<D>> levels;
  levels.reserve(points.size());
  for (const Vec<D>& X : points) {
    Levels<D>& level = levels.emplace_back();
    for (int k = 0; k < D; ++k)
      at(level, k) = static_cast<std::int32_t>(std::lround(scale * (X[k] - box.low[k])));
  }
  return levels;
}

template <int D>
int longest_axis(const std::vector<Levels<D>>& levels, std::span<const Index> points) {
  Levels<D> low = at(levels, points[0]), high = low;
  for (const Index A : points)
    for (int k = 0; k < D; ++k) {
      at(low, k) = std::min(at(low, k), at(at(levels, A), k));
      at(high, k) = std::max(at(high, k), at(at(levels, A), k));
    }
  int axis = 0;
  for (int k = 1; k < D; ++k)
    if (at(high, k) - at(low, k) > at(high, axis) - at(low, axis)) axis = k;
  return axis;
}

/// Halves the points order[begin .. end - 1] again and again, first at the begins of chunks.
template <int D>
void halve(const std::vector<Levels<D>>& levels, std::vector<Index>& order, Index begin, Index end,
           int chunk, int end_chunk) {
  if (end - begin < 2) return;
  const auto n = static_cast<Index>(order.size());
  const int middle_chunk = (chunk + end_chunk) / 2;
  const Index middle =
      middle_chunk > chunk ? chunk_begin(n, middle_chunk) : begin + (end - begin) / 2;
  const int axis =
      longest_axis<D>(levels, std::span(order).subspan(static_cast<std::size_t>(begin),
                                                       static_cast<std::size_t>(end - begin)));
  const auto key = [&](Index A) {
    const Levels<D>& level = at(levels, A);
    return std::tuple(at(level, axis), at(level, (axis + 1) % D), at(level, (axis + 2) % D), A);
  };
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                   [&](Index a, Index b) { return key(a) < key(b); });
  halve<D>(levels, order, begin, middle, chunk, middle_chunk);
  halve<D>(levels, order, middle, end, middle_chunk, end_chunk);
}

template <class T>
std::vector<T> permuted(const std::vector<T>& values, std::span<const Index> order) {
  std::vector<T> result;
  result.reserve(values.size());
  for (const Index old : order) result.push_back(at(values, old));
  return result;
}

/// The new number of each old node.
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
std::vector<Index> spatial_order(std::span<const Vec<D>> points) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto n = static_cast<Index>(points.size());
  if (n > 0) halve<D>(levels_of<D>(points), order, 0, n, 0, chunk_count(n));
  return order;
}

template <int D>
Vec<D> mark_of_order(std::span<const Vec<D>> points) {
  Vec<D> mark = Vec<D>::Zero();
  for (std::size_t A = 0; A < points.size(); ++A)
    mark += std::cos(static_cast<Real>(A)) * points[A];
  return mark;
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
  std::stable_sort(cell_order.begin(), cell_order.end(), [&](Index a, Index b) {
    return lowest_node(at(grid.cells, a)) < lowest_node(at(grid.cells, b));
  });
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
  std::vector<Index> order = spatial_order<D>(geometry.grid.X);
  renumber<D>(geometry, order);
  return order;
}

#define MENISCUS_INSTANTIATE(D)                                          \
  template std::vector<Index> spatial_order<D>(std::span<const Vec<D>>); \
  template Vec<D> mark_of_order<D>(std::span<const Vec<D>>);             \
  template void renumber<D>(Grid<D>&, std::span<const Index>);           \
  template void renumber<D>(Geometry<D>&, std::span<const Index>);       \
  template std::vector<Index> order_spatially<D>(Geometry<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
