// SPDX-License-Identifier: BSD-3-Clause
// Quadrature of nodal cells.
#include "body/grid/nodal_cells.hpp"

#include "body/grid/equal_cells.hpp"
#include "body/grid/octant_tables.hpp"
#include "meniscus/error.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

#include <numbers>

namespace meniscus {

namespace {

/// Calls f(point, lane) for the first `count` of four points.
template <int D, class F>
void for_lanes(const std::array<Lanes, D>& X, int count, F&& f) {
  const auto place = by_lane(X[0], X[1], D == 3 ? X[D - 1] : Lanes::zero());
  for (int lane = 0; lane < count; ++lane)
    f(Vec<D>(spatial(at(place, lane)).template head<D>()), lane);
}

/// Calls f(points, w, count) for each four points of an octant of a nodal cell. Lanes beyond
/// `count` have w = 0.
template <int D, class F>
void for_volume_points(const Grid<D>& grid, const NodeCells::Entry& octant, F&& f) {
  const CellMap<D> map(grid, octant.cell);
  const auto* simplex = map.simplex();
  for (const auto& p : simplex ? simplex->volume(simplex_corner<D>(octant.corner))
                               : map.table().volume(octant.corner)) {
    const FourCellPoints<D> four = map(p);
    f(four.X, p.w * determinant(four.J), p.count);
  }
}

/// Volume of parts of a nodal cell, and the integrals of X - Xn and (X - Xn)(X - Xn)^T, with the
/// node at Xn. Unlike moments of X they do not cancel far from the origin.
template <int D>
struct MomentsAboutNode {
  Real V = 0;
  Vec<D> first = Vec<D>::Zero();
  Mat<D> second = Mat<D>::Zero();

  void add_octant(const Grid<D>& grid, const NodeCells::Entry& octant, const Vec<D>& Xn) {
    Lanes w_sum = Lanes::zero();
    std::array<Lanes, D> w_arm;
    std::array<std::array<Lanes, D>, D> w_arm_arm;
    w_arm.fill(Lanes::zero());
    w_arm_arm.fill(w_arm);
    for_volume_points<D>(grid, octant, [&](const std::array<Lanes, D>& X, Lanes w, int) {
      if (grid.revolved) w *= 2 * std::numbers::pi * X[0];
      w_sum += w;
      for (std::size_t i = 0; i < D; ++i) {
        const Lanes of_i = w * (X[i] - Xn[static_cast<int>(i)]);
        w_arm[i] += of_i;
        for (std::size_t j = i; j < D; ++j)
          w_arm_arm[i][j] += of_i * (X[j] - Xn[static_cast<int>(j)]);
      }
    });
    V += sum(w_sum);
    for (int i = 0; i < D; ++i) {
      first[i] += sum(at(w_arm, i));
      for (int j = i; j < D; ++j) second(i, j) += sum(at(at(w_arm_arm, i), j));
      for (int j = 0; j < i; ++j) second(i, j) = second(j, i);
    }
  }
  /// Adds an octant of a parallelepiped. The columns of `edges` are half the edges at the node.
  void add_parallelepiped(const Mat<D>& edges) {
    const Real volume = std::abs(determinant<D>(edges));
    const Vec<D> middle = 0.5 * edges.rowwise().sum();
    V += volume;
    first += volume * middle;
    second += volume * (middle * middle.transpose() + edges * edges.transpose() / 12);
  }
};

template <int D>
void append_facet(CellQuadrature<D>& q, const CellMap<D>& map,
                  const std::vector<FourTabulatedPoints<D>>& points, int k, Real sign) {
  for (const auto& p : points) {
    const FourCellPoints<D> four = map(p);
    std::array<Lanes, D> dA = four.facet_normal(k);
    for (Lanes& component : dA) component *= sign * p.w;
    for_lanes<D>(four.X, p.count, [&](const Vec<D>& X, int) { q.facet_X.push_back(X); });
    for_lanes<D>(dA, p.count, [&](const Vec<D>& n_dA, int) { q.facet_dA.push_back(n_dA); });
  }
}

}  // namespace

template <int D>
NodalCells<D>::NodalCells(const Grid<D>& grid)
    : grid_(&grid),
      octants_(cells_of_nodes(grid)),
      equal_cells_(grid.revolved ? std::vector<Index>(grid.cells.size(), -1) : equal_cells(grid)),
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
    for (Index node = begin; node < end; ++node) integrate(node);
  });
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
  q.volume_X.clear();
  q.volume_w.clear();
  for (const auto& octant : octants_.of(node))
    for_volume_points<D>(*grid_, octant, [&](const auto& X, Lanes w, int count) {
      for_lanes<D>(X, count, [&](const Vec<D>& place, int lane) {
        q.volume_X.push_back(place);
        q.volume_w.push_back(w[lane]);
      });
    });
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
void NodalCells<D>::integrate(Index node) {
  const Vec<D>& origin = at(grid_->X, node);
  MomentsAboutNode<D> sum;
  for (const auto& octant : octants_.of(node)) {
    if (at(equal_cells_, octant.cell) < 0) {
      sum.add_octant(*grid_, octant, origin);
      continue;
    }
    const auto& corners = at(grid_->cells, octant.cell);
    Mat<D> edges;
    for (int k = 0; k < D; ++k)
      edges.col(k) = 0.5 * (at(grid_->X, at(corners, octant.corner ^ (1 << k))) - origin);
    sum.add_parallelepiped(edges);
  }
  const Vec<D> offset = sum.first / sum.V;
  at(volume_, node) = sum.V;
  at(centroid_, node) = origin + offset;
  at(covariance_, node) = sum.second / sum.V - offset * offset.transpose();
}

template class NodalCells<2>;
template class NodalCells<3>;

}  // namespace meniscus
