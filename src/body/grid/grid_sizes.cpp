// SPDX-License-Identifier: BSD-3-Clause
// Volumes, sizes and Gauss points of the cells of grids.
#include "body/grid/gauss.hpp"
#include "body/grid/grid.hpp"
#include "body/grid/octant_tables.hpp"
#include "body/grid/simplex.hpp"
#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <cmath>

namespace meniscus {

namespace {

/// The map of a hexahedral (quadrilateral) or simplex cell.
template <int D>
CellPoint<D, D> place_in(const Grid<D>& grid, Index cell,
                         const std::array<Vec<D>, (1 << D)>& corners, const Vec<D>& xi) {
  return is_simplex<D>(at(grid.cells, cell))
             ? simplex_point<D>(corners, grid.bulge(cell), collapsed_shares<D>(xi))
             : cell_point(corners, grid.bulge(cell), xi);
}

/// Calls f(X, weight) for the Gauss points of one cell.
template <int D, class F>
void for_gauss_points(const Grid<D>& grid, Index cell, const TensorRule<D>& rule, F&& f) {
  const auto corners = grid.corner_points(at(grid.cells, cell));
  for (std::size_t q = 0; q < rule.x.size(); ++q) {
    const CellPoint<D, D> p = place_in(grid, cell, corners, rule.x[q]);
    f(p.X, rule.w[q] * determinant<D>(p.J));
  }
}

template <int D>
std::vector<TabulatedPoint<D>> tabulated(const TensorRule<D>& rule) {
  std::vector<TabulatedPoint<D>> points;
  for (std::size_t q = 0; q < rule.x.size(); ++q)
    points.push_back(tabulate<D>(rule.x[q], rule.w[q]));
  return points;
}

/// Sum of the cells, each point weighted by weight(X).
template <int D, class F>
Real sum_over_cells(const Grid<D>& grid, F&& weight) {
  // det J has degree 2 per direction, and 2 D - 1 in curved cells; circles have degree 2.
  const TensorRule<D> straight = tensor_rule<D>(2),
                      curved = tensor_rule<D>(grid.revolved ? D + 1 : D);
  const auto of_straight = tabulated<D>(straight), of_curved = tabulated<D>(curved);
  return parallel_sum(grid.cell_count(), 0.0, [&](Index e) {
    const bool bulges = grid.bulge(e) != nullptr;
    Real sum = 0;
    if (is_simplex<D>(at(grid.cells, e))) {
      for_gauss_points(grid, e, bulges ? curved : straight,
                       [&](const Vec<D>& X, Real w) { sum += w * weight(X); });
      return sum;
    }
    const CellMap<D> map(grid, e);
    for (const auto& p : bulges ? of_curved : of_straight) {
      const CellPoint<D, D> point = map(p);
      sum += p.w * determinant<D>(point.J) * weight(point.X);
    }
    return sum;
  });
}

}  // namespace

template <int D>
Real volume(const Grid<D>& grid) {
  return sum_over_cells(grid, [&](const Vec<D>& X) { return circle(grid, X); });
}

template <int D>
Real mean_spacing(const Grid<D>& grid) {
  const Real V = sum_over_cells(grid, [](const Vec<D>&) { return 1.0; }) / grid.cell_count();
  // A cube consists of six tetrahedra, a square of two triangles.
  constexpr Real simplices = D == 3 ? 6 : 2;
  return std::pow(is_simplex<D>(grid.cells.front()) ? simplices * V : V, 1.0 / D);
}

namespace {

/// Mean square of the diagonals of a cell; for a simplex, of the cube that consists of such
/// simplices.
template <int D>
Real squared_diagonal(const Grid<D>& grid, Index cell, const Mat<D>& inverse_stretch) {
  constexpr int corners = Grid<D>::corners;
  const auto X = grid.corner_points(at(grid.cells, cell));
  Real sum = 0;
  if (is_simplex<D>(at(grid.cells, cell))) {
    // In a unit cube or square, the squared edges of one such simplex add up to 10 in 3D and 4 in
    // 2D.
    for (const auto& [i, j] : simplex_edges<D>())
      sum += (inverse_stretch *
              (at(X, at(simplex_corners<D>(), j)) - at(X, at(simplex_corners<D>(), i))))
                 .squaredNorm();
    return D * sum / (D == 3 ? 10 : 4);
  }
  for (int a = 0; a < corners / 2; ++a)
    sum += (inverse_stretch * (at(X, corners - 1 - a) - at(X, a))).squaredNorm();
  return sum / (corners / 2);
}

}  // namespace

template <int D>
std::vector<Real> diagonals_around_nodes(const Grid<D>& grid, const Mat<D>& stretch) {
  const Mat<D> inverse_stretch = inverse<D>(stretch);
  std::vector<Real> length(grid.X.size(), 0.0), cells(grid.X.size(), 0.0);
  for (Index e = 0; e < grid.cell_count(); ++e) {
    const Real diagonal = std::sqrt(squared_diagonal(grid, e, inverse_stretch));
    Index before = -1;
    for (const Index A : at(grid.cells, e)) {
      if (A == before) continue;  // a simplex repeats its corners
      before = A;
      at(length, A) += diagonal;
      at(cells, A) += 1;
    }
  }
  for (Index A = 0; A < grid.node_count(); ++A) at(length, A) /= at(cells, A);
  return length;
}

template <int D>
std::vector<Real> supports_by_cells(const Grid<D>& grid, const Mat<D>& stretch, Real factor) {
  std::vector<Real> supports = diagonals_around_nodes(grid, stretch);
  for (Real& length : supports) length *= factor;
  return supports;
}

template <int D>
Mat<D> mean_stretch(const Grid<D>& grid) {
  Mat<D> squares = Mat<D>::Zero();
  for (Index e = 0; e < grid.cell_count(); ++e) {
    const auto corners = grid.corner_points(at(grid.cells, e));
    if (is_simplex<D>(at(grid.cells, e))) {
      for (const auto& [i, j] : simplex_edges<D>()) {
        const Vec<D> edge =
            at(corners, at(simplex_corners<D>(), j)) - at(corners, at(simplex_corners<D>(), i));
        squares += edge * edge.transpose();
      }
      continue;
    }
    const Mat<D> J = cell_point<D>(corners, grid.bulge(e), Vec<D>::Zero()).J;
    squares += J * J.transpose();
  }
  if (grid.revolved)
    squares = Mat<D>(squares.diagonal().asDiagonal());  // the mirrored half counts, too
  const Mat<D> U = square_root<D>(squares / std::pow(determinant<D>(squares), 1.0 / D));
  return U.isApprox(Mat<D>::Identity(), 1e-9) ? Mat<D>(Mat<D>::Identity()) : U;
}

template <int D>
CellPoints<D> cell_gauss_points(const Grid<D>& grid, int k) {
  const TensorRule<D> rule = tensor_rule<D>(k);
  CellPoints<D> points;
  points.per_cell = static_cast<int>(rule.x.size());
  points.X.reserve(grid.cells.size() * rule.x.size());
  points.weight.reserve(grid.cells.size() * rule.x.size());
  for (Index e = 0; e < grid.cell_count(); ++e)
    for_gauss_points(grid, e, rule, [&](const Vec<D>& X, Real weight) {
      points.X.push_back(X);
      points.weight.push_back(weight * circle(grid, X));
    });
  return points;
}

#define MENISCUS_INSTANTIATE(D)                                                      \
  template Real volume(const Grid<D>&);                                              \
  template Real mean_spacing(const Grid<D>&);                                        \
  template Mat<D> mean_stretch(const Grid<D>&);                                      \
  template std::vector<Real> diagonals_around_nodes(const Grid<D>&, const Mat<D>&);  \
  template std::vector<Real> supports_by_cells(const Grid<D>&, const Mat<D>&, Real); \
  template CellPoints<D> cell_gauss_points(const Grid<D>&, int);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
