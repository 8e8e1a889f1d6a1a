// SPDX-License-Identifier: BSD-3-Clause
// Quadrature of nodal cells. Reference points and shape function values of all octants and octant
// facets are tabulated once.
#include "meniscus/body/nodal_cells.hpp"

#include "meniscus/body/gauss.hpp"
#include "meniscus/core/dense.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/parallel.hpp"

#include <fmt/core.h>

namespace meniscus {

namespace {

/// X X^T det J has degree 4 per direction, 2 D + 3 where the cell is curved.
template <int D>
int points_along(int k, unsigned curved) {
  return (curved >> k) & 1 ? D + 2 : 3;
}

/// Multilinear shape functions of the corners at one reference point.
template <int D>
struct TabulatedPoint {
  Eigen::Matrix<Real, 1 << D, 1> N;
  Eigen::Matrix<Real, 1 << D, D> dN;
  BulgeFunctions<D> bulge;
  Real w;
};

template <int D>
TabulatedPoint<D> tabulate(const Vec<D>& xi, Real w) {
  TabulatedPoint<D> point{{}, {}, BulgeFunctions<D>(xi), w};
  for (int a = 0; a < (1 << D); ++a) {
    // The shape function of a corner is the map of corner values that are 1 there and 0 elsewhere.
    std::array<Vec<D>, (1 << D)> unit;
    unit.fill(Vec<D>::Zero());
    at(unit, a)[0] = 1;
    const CellPoint<D, D> p = multilinear<D, D>(unit, xi);
    point.N[a] = p.X[0];
    point.dN.row(a) = p.J.row(0);
  }
  return point;
}

template <int D>
class OctantTable {
 public:
  using Points = std::vector<TabulatedPoint<D>>;

  /// For cells that are curved in the directions of the bits of `curved`.
  static const OctantTable& instance(unsigned curved) {
    static const std::vector<OctantTable> tables = [] {
      std::vector<OctantTable> all;
      for (unsigned c = 0; c < (1u << D); ++c) all.push_back(OctantTable(c));
      return all;
    }();
    return at(tables, curved);
  }
  const Points& volume(int corner) const { return at(volume_, corner); }
  /// The facet xi_k = 0 of the octant; the same object for the two octants that share it.
  const Points& inner(int corner, int k) const { return at(inner_, (corner & ~(1 << k)) * D + k); }
  /// The facet xi_k = +-1 of the octant.
  const Points& outer(int corner, int k) const { return at(outer_, corner * D + k); }

 private:
  explicit OctantTable(unsigned curved) {
    std::array<int, D> count;
    for (int k = 0; k < D; ++k) at(count, k) = points_along<D>(k, curved);
    const TensorRule<D> cube = tensor_rule<D>(count);
    for (int corner = 0; corner < (1 << D); ++corner) {
      Points octant;
      for (std::size_t q = 0; q < cube.x.size(); ++q) {
        Vec<D> xi;
        for (int k = 0; k < D; ++k) xi[k] = 0.5 * (corner_sign(corner, k) + cube.x[q][k]);
        octant.push_back(tabulate<D>(xi, cube.w[q] / (1 << D)));
      }
      volume_.push_back(octant);
      for (int k = 0; k < D; ++k) {
        inner_.push_back(facet(corner, k, 0, curved));
        outer_.push_back(facet(corner, k, corner_sign(corner, k), curved));
      }
    }
  }

  static Points facet(int corner, int k, Real level, unsigned curved) {
    std::array<int, D - 1> count;
    for (int l = 0, d = 0; l < D; ++l)
      if (l != k) at(count, d++) = points_along<D>(l, curved);
    const TensorRule<D - 1> square = tensor_rule<D - 1>(count);
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

/// The map of one cell at tabulated points.
template <int D>
class CellMap {
 public:
  CellMap(const Grid<D>& grid, Index cell) : bulge_(grid.bulge(cell)) {
    for (int a = 0; a < (1 << D); ++a) corners_.col(a) = at(grid.X, at(at(grid.cells, cell), a));
  }
  const OctantTable<D>& table() const {
    return OctantTable<D>::instance(bulge_ ? bulge_->curved : 0);
  }
  CellPoint<D, D> operator()(const TabulatedPoint<D>& p) const {
    // Not the products for large matrices, which take most of the time here.
    CellPoint<D, D> point{corners_.lazyProduct(p.N), corners_.lazyProduct(p.dN)};
    if (bulge_) {
      point.X += bulge_->deviation.lazyProduct(p.bulge.N);
      point.J += bulge_->deviation.lazyProduct(p.bulge.dN);
    }
    return point;
  }

 private:
  Eigen::Matrix<Real, D, (1 << D)> corners_;
  const Bulge<D>* bulge_;
};

/// Column k of cof J: normal of the surface xi_k = const, its length the area ratio.
template <int D>
Vec<D> facet_normal(const Mat<D>& J, int k) {
  if constexpr (D == 3)
    return cross(J.col((k + 1) % 3), J.col((k + 2) % 3));
  else
    return k == 0 ? Vec<2>(J(1, 1), -J(0, 1)) : Vec<2>(-J(1, 0), J(0, 0));
}

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
    for (const auto& p : map.table().volume(corner)) {
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
    for (int k = 0; k < D; ++k)
      append_facet<D>(q, map, map.table().inner(corner, k), k, -corner_sign(corner, k));
  }
  q.body_facets_begin = q.facet_X.size();
  q.body_facets.clear();
  for (const auto& [cell, corner] : octants_.of(node))
    for (int k = 0; k < D; ++k) {
      const int side = 2 * k + ((corner >> k) & 1);
      if (!((at(boundary_sides_, cell) >> side) & 1)) continue;
      const CellMap<D> map(*grid_, cell);
      const std::size_t begin = q.facet_X.size();
      append_facet<D>(q, map, map.table().outer(corner, k), k, corner_sign(corner, k));
      q.body_facets.push_back({cell, side, begin, q.facet_X.size()});
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
