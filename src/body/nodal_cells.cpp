// SPDX-License-Identifier: BSD-3-Clause
// Quadrature of nodal cells.
#include "meniscus/body/nodal_cells.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/core/parallel.hpp"

#include <fmt/core.h>

#include "octant_tables.hpp"

namespace meniscus {

namespace {

template <int D>
void append_facet(CellQuadrature<D>& q, const CellMap<D>& map,
                  const std::vector<TabulatedPoint<D>>& points, int k, Real sign) {
  for (const auto& p : points) {
    const CellPoint<D, D> point = map(p);
    q.facet_X.push_back(point.X);
    q.facet_dA.push_back(sign * (p.w * facet_normal<D>(point.J, k)));
  }
}

}  // namespace

template <int D>
NodalCells<D>::NodalCells(const Grid<D>& grid)
    : grid_(&grid),
      octants_(cells_of_nodes(grid)),
      boundary_sides_(grid.cells.size(), 0),
      volume_(grid.X.size()),
      centroid_(grid.X.size()),
      covariance_(grid.X.size()) {
  for (Index node = 0; node < grid.node_count(); ++node)
    if (octants_.of(node).empty())
      throw InputError(fmt::format("node {} of the grid belongs to no cell", node));
  for (const auto& facet : grid.facets)
    at(boundary_sides_, facet.cell) |= static_cast<std::uint8_t>(1u << facet.side);
  for_chunks(grid.node_count(), [&](Index, Index begin, Index end) {
    CellQuadrature<D> q;
    for (Index node = begin; node < end; ++node) integrate(node, q);
  });
}

template <int D>
void NodalCells<D>::volume_points(Index node, CellQuadrature<D>& q) const {
  q.volume_X.clear();
  q.volume_w.clear();
  for (const auto& [cell, corner] : octants_.of(node)) {
    const CellMap<D> map(*grid_, cell);
    const auto* simplex = map.simplex();
    for (const auto& p :
         simplex ? simplex->volume(simplex_corner<D>(corner)) : map.table().volume(corner)) {
      const CellPoint<D, D> point = map(p);
      q.volume_X.push_back(point.X);
      q.volume_w.push_back(p.w * determinant<D>(point.J));
    }
  }
}

template <int D>
void NodalCells<D>::facet_points(Index node, CellQuadrature<D>& q) const {
  q.facet_X.clear();
  q.facet_dA.clear();
  for (const auto& [cell, corner] : octants_.of(node)) {
    const CellMap<D> map(*grid_, cell);
    if (const auto* simplex = map.simplex()) {
      const int i = simplex_corner<D>(corner);
      for (const int j : directions_at<D>(i)) {
        const auto& side = simplex->between(i, j);
        append_facet<D>(q, map, side.points, side.k, i < j ? 1 : -1);
      }
      continue;
    }
    for (int k = 0; k < D; ++k)
      append_facet<D>(q, map, map.table().inner(corner, k), k, -corner_sign(corner, k));
  }
  q.body_facets_begin = q.facet_X.size();
  append_boundary(node, q);
}

template <int D>
void NodalCells<D>::append_boundary(Index node, CellQuadrature<D>& q) const {
  q.body_facets.clear();
  for (const auto& [cell, corner] : octants_.of(node)) {
    if (at(boundary_sides_, cell) == 0) continue;
    const CellMap<D> map(*grid_, cell);
    const auto* simplex = map.simplex();
    const int i = simplex_corner<D>(corner);
    for (int k = 0; k < D; ++k) {
      const int opposite = at(directions_at<D>(i), k);
      const int side = simplex ? side_opposite<D>(opposite) : 2 * k + ((corner >> k) & 1);
      if (!((at(boundary_sides_, cell) >> side) & 1)) continue;
      const std::size_t begin = q.facet_X.size();
      if (simplex) {
        const auto& outer = simplex->on_side(i, opposite);
        append_facet<D>(q, map, outer.points, outer.k, -1);
      } else {
        append_facet<D>(q, map, map.table().outer(corner, k), k, corner_sign(corner, k));
      }
      q.body_facets.push_back({cell, side, begin, q.facet_X.size()});
    }
  }
}

template <int D>
void NodalCells<D>::quadrature(Index node, CellQuadrature<D>& q) const {
  volume_points(node, q);
  facet_points(node, q);
}

template <int D>
void NodalCells<D>::boundary_points(Index node, CellQuadrature<D>& q) const {
  q.facet_X.clear();
  q.facet_dA.clear();
  q.body_facets_begin = 0;
  append_boundary(node, q);
}

template <int D>
void NodalCells<D>::integrate(Index node, CellQuadrature<D>& q) {
  volume_points(node, q);
  // Moments about the node, not the origin: no cancellation far from it.
  const Vec<D>& origin = at(grid_->X, node);
  Real V = 0;
  Vec<D> first = Vec<D>::Zero();
  Mat<D> second = Mat<D>::Zero();
  for (std::size_t p = 0; p < q.volume_X.size(); ++p) {
    const Vec<D> arm = q.volume_X[p] - origin;
    V += q.volume_w[p];
    first += q.volume_w[p] * arm;
    second += q.volume_w[p] * (arm * arm.transpose());
  }
  const Vec<D> offset = first / V;
  at(volume_, node) = V;
  at(centroid_, node) = origin + offset;
  at(covariance_, node) = second / V - offset * offset.transpose();
}

template class NodalCells<2>;
template class NodalCells<3>;

}  // namespace meniscus
