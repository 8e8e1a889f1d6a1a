// SPDX-License-Identifier: BSD-3-Clause
// Leaves out cells and facets beyond the axis.
#include "body/shapes/half_plane.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace meniscus {
namespace {

/// True if f(node) holds for all nodes of a cell or facet.
template <class Nodes, class F>
bool all_nodes(const Nodes& nodes, F&& f) {
  return std::all_of(nodes.begin(), nodes.end(), f);
}

void move_to_axis(std::vector<Vec<2>>& X) {
  constexpr Real round_off = 1e-9;
  Real size = 0;
  for (const Vec<2>& x : X) size = std::max(size, (x - X.front()).norm());
  for (Vec<2>& x : X)
    if (std::abs(x[0]) <= round_off * size) x[0] = 0;
}

}  // namespace

Geometry<2> half_plane(Geometry<2> geometry) {
  Grid<2> grid = std::move(geometry.grid);
  move_to_axis(grid.X);
  const auto x = [&](Index node) { return at(grid.X, node)[0]; };
  std::vector<Index> number_of_cell(grid.cells.size(), -1);
  std::vector<Grid<2>::Cell> cells;
  std::vector<Index> bulge_of;
  std::vector<bool> used(grid.X.size(), false);
  for (Index e = 0; e < grid.cell_count(); ++e) {
    const auto& cell = at(grid.cells, e);
    if (all_nodes(cell, [&](Index node) { return x(node) <= 0; })) continue;
    if (!all_nodes(cell, [&](Index node) { return x(node) >= 0; }))
      throw InputError(fmt::format(
          "has a cell across the axis x = 0, at y = {:.6g}; allowed are shapes with nodes on the "
          "axis, such as a centre on the axis and an even number of cells across it, or shapes "
          "that "
          "end there",
          at(grid.X, cell[0])[1]));
    at(number_of_cell, e) = static_cast<Index>(cells.size());
    cells.push_back(cell);
    if (!grid.bulge_of.empty()) bulge_of.push_back(at(grid.bulge_of, e));
    for (const Index node : cell) at(used, node) = true;
  }
  if (cells.empty())
    throw InputError("lies at x < 0; allowed is x >= 0, the distance from the axis");

  std::vector<Index> order, number(grid.X.size(), -1);
  for (Index node = 0; node < grid.node_count(); ++node)
    if (at(used, node)) {
      at(number, node) = static_cast<Index>(order.size());
      order.push_back(node);
    }
  std::vector<Facet<2>> facets;
  for (Facet<2> facet : grid.facets) {
    if (at(number_of_cell, facet.cell) < 0 ||
        all_nodes(facet.nodes, [&](Index node) { return x(node) == 0; }))
      continue;
    facet.cell = at(number_of_cell, facet.cell);
    for (Index& node : facet.nodes) node = at(number, node);
    facets.push_back(facet);
  }
  for (auto& cell : cells)
    for (Index& node : cell) node = at(number, node);
  std::vector<Vec<2>> X;
  for (const Index node : order) X.push_back(at(grid.X, node));
  grid.X = std::move(X);
  grid.cells = std::move(cells);
  grid.facets = std::move(facets);
  grid.bulge_of = std::move(bulge_of);
  grid.revolved = true;
  geometry.grid = std::move(grid);
  geometry.surface = geometry.surface->renumbered(order);
  return geometry;
}

}  // namespace meniscus
