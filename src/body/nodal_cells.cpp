// SPDX-License-Identifier: BSD-3-Clause
// Quadrature of nodal cells. Reference points and shape function values of all octants and octant
// facets are tabulated once.
#include "meniscus/body/nodal_cells.hpp"

#include "meniscus/body/gauss.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/parallel.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace meniscus {

namespace {

constexpr int points_per_direction = 3;  // X X^T det J has degree 4 per direction

/// Multilinear shape functions of the corners at one reference point.
template <int D>
struct TabulatedPoint {
  Eigen::Matrix<Real, 1 << D, 1> N;
  Eigen::Matrix<Real, 1 << D, D> dN;
  Real w;
};

template <int D>
TabulatedPoint<D> tabulate(const Vec<D>& xi, Real w) {
  TabulatedPoint<D> point;
  for (int a = 0; a < (1 << D); ++a) {
    // The shape function of a corner is the map of corner values that are 1 there and 0 elsewhere.
    std::array<Vec<D>, (1 << D)> unit;
    unit.fill(Vec<D>::Zero());
    at(unit, a)[0] = 1;
    const CellPoint<D, D> p = multilinear<D, D>(unit, xi);
    point.N[a] = p.X[0];
    point.dN.row(a) = p.J.row(0);
  }
  point.w = w;
  return point;
}

template <int D>
class OctantTable {
 public:
  using Points = std::vector<TabulatedPoint<D>>;

  static const OctantTable& instance() {
    static const OctantTable table;
    return table;
  }
  const Points& volume(int corner) const { return at(volume_, corner); }
  /// The facet xi_k = 0 of the octant; the same object for the two octants that share it.
  const Points& inner(int corner, int k) const { return at(inner_, (corner & ~(1 << k)) * D + k); }
  /// The facet xi_k = +-1 of the octant.
  const Points& outer(int corner, int k) const { return at(outer_, corner * D + k); }

 private:
  OctantTable() {
    const TensorRule<D> cube = tensor_rule<D>(points_per_direction);
    for (int corner = 0; corner < (1 << D); ++corner) {
      Points octant;
      for (std::size_t q = 0; q < cube.x.size(); ++q) {
        Vec<D> xi;
        for (int k = 0; k < D; ++k) xi[k] = 0.5 * (corner_sign(corner, k) + cube.x[q][k]);
        octant.push_back(tabulate<D>(xi, cube.w[q] / (1 << D)));
      }
      volume_.push_back(octant);
      for (int k = 0; k < D; ++k) {
        inner_.push_back(facet(corner, k, 0));
        outer_.push_back(facet(corner, k, corner_sign(corner, k)));
      }
    }
  }

  static Points facet(int corner, int k, Real level) {
    const TensorRule<D - 1> square = tensor_rule<D - 1>(points_per_direction);
    Points points;
    for (std::size_t q = 0; q < square.x.size(); ++q) {
      Vec<D> xi;
      for (int l = 0, d = 0; l < D; ++l)
        xi[l] = l == k ? level : 0.5 * (corner_sign(corner, l) + square.x[q][d++]);
      points.push_back(tabulate<D>(xi, square.w[q] / (1 << (D - 1))));
    }
    return points;
  }

  std::vector<Points> volume_, inner_, outer_;
};

template <int D>
using Corners = Eigen::Matrix<Real, D, (1 << D)>;

template <int D>
Corners<D> gather(const Grid<D>& grid, Index cell) {
  Corners<D> corners;
  for (int a = 0; a < (1 << D); ++a) corners.col(a) = at(grid.X, at(at(grid.cells, cell), a));
  return corners;
}

/// Column k of cof J: normal of the surface xi_k = const, its length the area ratio.
template <int D>
Vec<D> facet_normal(const Mat<D>& J, int k) {
  if constexpr (D == 3)
    return J.col((k + 1) % 3).cross(J.col((k + 2) % 3));
  else
    return k == 0 ? Vec<2>(J(1, 1), -J(0, 1)) : Vec<2>(-J(1, 0), J(0, 0));
}

template <int D>
void append_facet(CellQuadrature<D>& q, const Corners<D>& corners,
                  const std::vector<TabulatedPoint<D>>& points, int k, Real sign) {
  for (const auto& p : points) {
    const Mat<D> J = corners * p.dN;
    q.facet_X.push_back(corners * p.N);
    q.facet_dA.push_back(sign * (p.w * facet_normal<D>(J, k)));
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
      throw InputError(fmt::format("Node {} of the grid belongs to no cell.", node));
  for (const auto& facet : grid.facets)
    at(boundary_sides_, facet.cell) |= static_cast<std::uint8_t>(1u << facet.side);
  for_chunks(grid.node_count(), [&](Index, Index begin, Index end) {
    CellQuadrature<D> q;
    for (Index node = begin; node < end; ++node) integrate(node, q);
  });
}

template <int D>
void NodalCells<D>::volume_points(Index node, CellQuadrature<D>& q) const {
  const auto& table = OctantTable<D>::instance();
  q.volume_X.clear();
  q.volume_w.clear();
  for (const auto& [cell, corner] : octants_.of(node)) {
    const Corners<D> corners = gather(*grid_, cell);
    for (const auto& p : table.volume(corner)) {
      const Mat<D> J = corners * p.dN;
      q.volume_X.push_back(corners * p.N);
      q.volume_w.push_back(p.w * J.determinant());
    }
  }
}

template <int D>
void NodalCells<D>::facet_points(Index node, CellQuadrature<D>& q) const {
  const auto& table = OctantTable<D>::instance();
  q.facet_X.clear();
  q.facet_dA.clear();
  for (const auto& [cell, corner] : octants_.of(node)) {
    const Corners<D> corners = gather(*grid_, cell);
    for (int k = 0; k < D; ++k)
      append_facet<D>(q, corners, table.inner(corner, k), k, -corner_sign(corner, k));
  }
  q.body_facets_begin = q.facet_X.size();
  for (const auto& [cell, corner] : octants_.of(node))
    for (int k = 0; k < D; ++k) {
      const int side = 2 * k + ((corner >> k) & 1);
      if ((at(boundary_sides_, cell) >> side) & 1)
        append_facet<D>(q, gather(*grid_, cell), table.outer(corner, k), k, corner_sign(corner, k));
    }
}

template <int D>
void NodalCells<D>::quadrature(Index node, CellQuadrature<D>& q) const {
  volume_points(node, q);
  facet_points(node, q);
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
