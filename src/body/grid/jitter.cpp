// SPDX-License-Identifier: BSD-3-Clause
// Random displacement of interior nodes.
#include "body/grid/grid.hpp"
#include "meniscus/error.hpp"
#include "numbers/random.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <random>

namespace meniscus {

namespace {

/// The shortest edge at each node before any node moves.
template <int D>
std::vector<Real> shortest_edges(const Grid<D>& grid) {
  std::vector<Real> shortest(grid.X.size(), std::numeric_limits<Real>::max());
  for (const auto& cell : grid.cells)
    for (int a = 0; a < Grid<D>::corners; ++a)
      for (int k = 0; k < D; ++k) {
        const Index i = at(cell, a), j = at(cell, a ^ (1 << k));
        if (i != j)
          at(shortest, i) = std::min(at(shortest, i), (at(grid.X, i) - at(grid.X, j)).norm());
      }
  return shortest;
}

/// Moves node i to a random place in the box of half-width `reach` around it. Returns false if
/// every draw folds a cell.
template <int D>
bool move_node(Grid<D>& grid, Index i, Real reach, std::span<const NodeCells::Entry> cells,
               std::mt19937_64& bits) {
  const Vec<D> place = at(grid.X, i);
  for (int draw = 0; draw < 100; ++draw) {
    for (int k = 0; k < D; ++k) at(grid.X, i)[k] = place[k] + reach * symmetric_uniform(bits);
    if (grid.revolved && place[0] == 0) at(grid.X, i)[0] = 0;  // it stays on the axis
    if (std::none_of(cells.begin(), cells.end(),
                     [&](const auto& e) { return find_fold(grid, e.cell).has_value(); }))
      return true;
  }
  at(grid.X, i) = place;
  return false;
}

}  // namespace

template <int D>
void jitter_interior(Grid<D>& grid, Real fraction, std::uint64_t seed) {
  if (!(fraction >= 0))
    throw InputError(fmt::format("the jitter must not be negative, but is {:g}", fraction));
  const std::vector<Real> edge = shortest_edges(grid);
  const NodeCells cells = cells_of_nodes(grid);
  std::vector<char> fixed(grid.X.size(), 0);
  for (const Index i : boundary_nodes(grid)) at(fixed, i) = 1;
  std::mt19937_64 bits(seed);
  for (Index i = 0; i < grid.node_count(); ++i)
    if (!at(fixed, i) && !move_node(grid, i, fraction * at(edge, i), cells.of(i), bits))
      throw InputError(fmt::format(
          "a jitter of {:g} folds the cells at node {} in 100 of 100 draws; use a smaller one",
          fraction, i));
}

template void jitter_interior(Grid<2>&, Real, std::uint64_t);
template void jitter_interior(Grid<3>&, Real, std::uint64_t);

}  // namespace meniscus
