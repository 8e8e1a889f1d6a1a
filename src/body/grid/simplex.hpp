// SPDX-License-Identifier: BSD-3-Clause
// Tetrahedra (2D: triangles) as collapsed hexahedra (quadrilaterals), and their nodal cells (RKPM
// note 5.4).
//
// A tetrahedron abcd is the cell a b c c d d d d, a triangle abc the cell a b c c. The multilinear
// map of such a cell gives a position by barycentric coordinates, X = sum_i lambda_i X_i. Functions
// that integrate over cells or facets need no more than this.
#pragma once
#include "body/grid/grid.hpp"

#include <array>

namespace meniscus {

/// The corners of the cell that are the corners of the simplex.
template <int D>
constexpr std::array<int, D + 1> simplex_corners() {
  if constexpr (D == 3)
    return {0, 1, 2, 4};
  else
    return {0, 1, 2};
}

/// The corner of the simplex at this corner of the cell.
template <int D>
constexpr int simplex_corner(int corner) {
  return corner < 3 ? corner : corner < 4 ? 2 : 3;
}

template <int D>
constexpr bool is_simplex(const std::array<Index, (1 << D)>& cell) {
  if constexpr (D == 3)
    return cell[4] == cell[7];
  else
    return cell[2] == cell[3];
}

/// The triangle abc as the quadrilateral a b c c, the tetrahedron abcd as the hexahedron a b c c d
/// d d d.
constexpr std::array<Index, 4> collapsed(const std::array<Index, 3>& triangle) {
  return {triangle[0], triangle[1], triangle[2], triangle[2]};
}
constexpr std::array<Index, 8> collapsed(const std::array<Index, 4>& tetrahedron) {
  const auto& t = tetrahedron;
  return {t[0], t[1], t[2], t[2], t[3], t[3], t[3], t[3]};
}

/// The side of the cell opposite to corner i of the simplex.
template <int D>
constexpr int side_opposite(int i) {
  constexpr std::array<int, 4> sides{1, 0, 2, 4};
  return at(sides, i);
}

/// The corners i < j at the ends of each edge.
template <int D>
constexpr auto simplex_edges() {
  std::array<std::array<int, 2>, D*(D + 1) / 2> edges{};
  std::size_t count = 0;
  for (int i = 0; i <= D; ++i)
    for (int j = i + 1; j <= D; ++j) edges[count++] = {i, j};
  return edges;
}

/// Barycentric coordinates lambda_i at a point, and their derivatives d lambda_i / d xi_k.
template <int D>
struct Shares {
  Eigen::Matrix<Real, D + 1, 1> value = Eigen::Matrix<Real, D + 1, 1>::Zero();
  Eigen::Matrix<Real, D + 1, D> slope = Eigen::Matrix<Real, D + 1, D>::Zero();
};

/// The coordinates in the collapsed cell at xi in [-1, 1]^D.
template <int D>
Shares<D> collapsed_shares(const Vec<D>& xi) {
  Shares<D> shares;
  for (int a = 0; a < (1 << D); ++a) {
    Real N = 1;
    Vec<D> dN = Vec<D>::Ones();
    for (int k = 0; k < D; ++k) {
      const Real end = (a >> k) & 1 ? 1 : -1, value = 0.5 * (1 + end * xi[k]);
      N *= value;
      for (int l = 0; l < D; ++l) dN[l] *= l == k ? 0.5 * end : value;
    }
    shares.value[simplex_corner<D>(a)] += N;
    shares.slope.row(simplex_corner<D>(a)) += dN.transpose();
  }
  return shares;
}

/// The corners other than i, in the order of the directions of the part of the simplex at corner i.
/// These directions form a right-handed system.
template <int D>
constexpr std::array<int, D> directions_at(int i) {
  if constexpr (D == 2) {
    return {(i + 1) % 3, (i + 2) % 3};
  } else {
    constexpr std::array<std::array<int, 3>, 4> others{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    return at(others, i);
  }
}

/// The coordinates in the part of the simplex at corner i, at xi in [-1, 1]^D. This part is a
/// hexahedron (quadrilateral) between the corner, the middles of edges and sides, and the middle of
/// the simplex. All coordinates are multilinear in it.
template <int D>
Shares<D> part_shares(int i, const Vec<D>& xi) {
  const std::array<int, D> others = directions_at<D>(i);
  Shares<D> shares;
  for (unsigned a = 0; a < (1u << D); ++a) {
    Real N = 1;
    Vec<D> dN = Vec<D>::Ones();
    int count = 1;
    for (int k = 0; k < D; ++k) {
      const Real end = (a >> k) & 1 ? 1 : -1, value = 0.5 * (1 + end * xi[k]);
      count += end > 0;
      N *= value;
      for (int l = 0; l < D; ++l) dN[l] *= l == k ? 0.5 * end : value;
    }
    const auto add = [&](int corner) {
      shares.value[corner] += N / count;
      shares.slope.row(corner) += dN.transpose() / count;
    };
    add(i);
    for (int k = 0; k < D; ++k)
      if ((a >> k) & 1) add(at(others, k));
  }
  return shares;
}

/// The functions 4 lambda_i lambda_j of the edges: 1 in the middle of one edge, 0 on the others.
/// The map of a curved simplex adds these functions times the first columns of its Bulge.
template <int D>
BulgeFunctions<D> edge_functions(const Shares<D>& shares) {
  BulgeFunctions<D> functions(Vec<D>::Zero());
  functions.N.setZero();
  functions.dN.setZero();
  Eigen::Index e = 0;
  for (const auto& [i, j] : simplex_edges<D>()) {
    functions.N[e] = 4 * shares.value[i] * shares.value[j];
    functions.dN.row(e) =
        4 * (shares.value[i] * shares.slope.row(j) + shares.value[j] * shares.slope.row(i));
    ++e;
  }
  return functions;
}

/// The position at the barycentric coordinates `shares`, and its derivatives by the parameters of
/// `shares`. `corners` are the corners of the collapsed cell.
template <int D>
CellPoint<D, D> simplex_point(const std::array<Vec<D>, (1 << D)>& corners, const Bulge<D>* bulge,
                              const Shares<D>& shares) {
  CellPoint<D, D> point{Vec<D>::Zero(), Mat<D>::Zero()};
  for (int i = 0; i <= D; ++i) {
    const Vec<D>& X = at(corners, at(simplex_corners<D>(), i));
    point.X += shares.value[i] * X;
    point.J += X * shares.slope.row(i);
  }
  if (bulge) {
    const BulgeFunctions<D> functions = edge_functions<D>(shares);
    point.X += bulge->deviation.lazyProduct(functions.N);
    point.J += bulge->deviation.lazyProduct(functions.dN);
  }
  return point;
}

}  // namespace meniscus
