// SPDX-License-Identifier: BSD-3-Clause
// Quadrature of nodal cells. Reference points and shape function values of all octants and octant
// facets are tabulated once.
#include "meniscus/body/nodal_cells.hpp"

#include "meniscus/body/gauss.hpp"
#include "meniscus/body/simplex.hpp"
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

/// The parts of a simplex at its corners, as octants.
template <int D>
class SimplexTable {
 public:
  using Points = std::vector<TabulatedPoint<D>>;
  /// Where direction k of a part ends.
  struct Side {
    Points points;
    int k = 0;
  };

  static const SimplexTable& instance(bool curved) {
    static const SimplexTable straight(3), bent(D + 2);
    return curved ? bent : straight;
  }
  const Points& volume(int i) const { return at(volume_, i); }
  /// Between the parts at the corners i and j, seen from the lesser of them.
  const Side& between(int i, int j) const {
    return at(end_, std::min(i, j) * (D + 1) + std::max(i, j));
  }
  /// Of the part at corner i, on the side of the simplex opposite to corner o.
  const Side& on_side(int i, int o) const { return at(begin_, i * (D + 1) + o); }

 private:
  explicit SimplexTable(int points) : begin_((D + 1) * (D + 1)), end_((D + 1) * (D + 1)) {
    const TensorRule<D> cube = tensor_rule<D>(points);
    const TensorRule<D - 1> square = tensor_rule<D - 1>(points);
    for (int i = 0; i <= D; ++i) {
      Points& part = volume_.emplace_back();
      for (std::size_t q = 0; q < cube.x.size(); ++q)
        part.push_back(tabulated(part_shares<D>(i, cube.x[q]), cube.w[q]));
      for (int k = 0; k < D; ++k) {
        const int other = at(directions_at<D>(i), k);
        for (const bool end : {false, true}) {
          Side& side = at(end ? end_ : begin_, i * (D + 1) + other);
          side.k = k;
          for (std::size_t q = 0; q < square.x.size(); ++q) {
            Vec<D> xi;
            for (int l = 0, d = 0; l < D; ++l) xi[l] = l == k ? (end ? 1 : -1) : square.x[q][d++];
            side.points.push_back(tabulated(part_shares<D>(i, xi), square.w[q]));
          }
        }
      }
    }
  }

  static TabulatedPoint<D> tabulated(const Shares<D>& shares, Real w) {
    TabulatedPoint<D> point{{}, {}, edge_functions<D>(shares), w};
    point.N.setZero();
    point.dN.setZero();
    for (int i = 0; i <= D; ++i) {
      point.N[at(simplex_corners<D>(), i)] = shares.value[i];
      point.dN.row(at(simplex_corners<D>(), i)) = shares.slope.row(i);
    }
    return point;
  }

  std::vector<Points> volume_;
  std::vector<Side> begin_, end_;
};

/// The map of one cell at tabulated points.
template <int D>
class CellMap {
 public:
  CellMap(const Grid<D>& grid, Index cell)
      : bulge_(grid.bulge(cell)), simplex_(is_simplex<D>(at(grid.cells, cell))) {
    for (int a = 0; a < (1 << D); ++a) corners_.col(a) = at(grid.X, at(at(grid.cells, cell), a));
  }
  const OctantTable<D>& table() const {
    return OctantTable<D>::instance(bulge_ ? bulge_->curved : 0);
  }
  /// Of a simplex; null for others.
  const SimplexTable<D>* simplex() const {
    return simplex_ ? &SimplexTable<D>::instance(bulge_ != nullptr) : nullptr;
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
  bool simplex_;
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
