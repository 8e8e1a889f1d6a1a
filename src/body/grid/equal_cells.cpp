// SPDX-License-Identifier: BSD-3-Clause
// Finds equal cells of a grid.
#include "body/grid/equal_cells.hpp"

#include "body/grid/simplex.hpp"

#include <algorithm>

namespace meniscus {
namespace {

constexpr Real same_edge = 1e-13;  // relative to the longest edge

template <int D>
using Edges = std::array<Vec<D>, D>;  // [k] edge along xi_k

template <int D>
Edges<D> edges_of(const Grid<D>& grid, Index cell) {
  const auto& corners = at(grid.cells, cell);
  Edges<D> edges;
  for (int k = 0; k < D; ++k)
    at(edges, k) = at(grid.X, at(corners, 1 << k)) - at(grid.X, corners[0]);
  return edges;
}

template <int D>
Real longest(const Edges<D>& edges) {
  Real square = 0;
  for (const Vec<D>& edge : edges) square = std::max(square, edge.squaredNorm());
  return std::sqrt(square);
}

template <int D>
bool are_close(const Edges<D>& a, const Edges<D>& b) {
  const Real small = same_edge * longest<D>(a);
  return std::equal(a.begin(), a.end(), b.begin(), [&](const Vec<D>& one, const Vec<D>& other) {
    return (one - other).squaredNorm() <= small * small;
  });
}

template <int D>
bool is_parallelepiped(const Grid<D>& grid, Index cell, const Edges<D>& edges) {
  const auto& corners = at(grid.cells, cell);
  if (grid.bulge(cell) || is_simplex<D>(corners)) return false;
  const Real small = same_edge * longest<D>(edges);
  for (int a = 0; a < (1 << D); ++a) {
    Vec<D> X = at(grid.X, corners[0]);
    for (int k = 0; k < D; ++k)
      if ((a >> k) & 1) X += at(edges, k);
    if ((at(grid.X, at(corners, a)) - X).squaredNorm() > small * small) return false;
  }
  return true;
}

}  // namespace

template <int D>
std::vector<Index> equal_cells(const Grid<D>& grid) {
  std::vector<Index> number(grid.cells.size(), -1);
  Index last = -1;
  for (Index cell = 0; cell < grid.cell_count(); ++cell) {
    const Edges<D> edges = edges_of(grid, cell);
    if (!is_parallelepiped<D>(grid, cell, edges)) continue;
    if (last < 0 || !are_close<D>(edges, edges_of(grid, last))) last = cell;
    at(number, cell) = last;
  }
  return number;
}

template std::vector<Index> equal_cells(const Grid<2>&);
template std::vector<Index> equal_cells(const Grid<3>&);

}  // namespace meniscus
