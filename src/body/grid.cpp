// SPDX-License-Identifier: BSD-3-Clause
// Boundary, checks, volume and Gauss points of grids.
#include "meniscus/body/grid.hpp"

#include "meniscus/body/gauss.hpp"
#include "meniscus/core/dense.hpp"
#include "meniscus/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace meniscus {

namespace {

/// Local corners of a side of the reference cell, in the tensor order of an outward facet.
template <int D>
std::array<int, (1 << (D - 1))> side_corners(int side) {
  const int k = side / 2, upper = side % 2;
  std::array<int, (1 << (D - 1))> local;
  if constexpr (D == 3) {
    int first = (k + 1) % 3, second = (k + 2) % 3;
    if (!upper) std::swap(first, second);
    for (int a = 0; a < 4; ++a)
      at(local, a) = (upper << k) | ((a & 1) << first) | ((a >> 1) << second);
  } else {
    const bool ascending = (k == 0) == (upper == 1);
    for (int a = 0; a < 2; ++a) at(local, a) = (upper << k) | ((ascending ? a : 1 - a) << (1 - k));
  }
  return local;
}

template <int D>
std::string place(const Vec<D>& X) {
  return D == 2 ? fmt::format("({:g}, {:g})", X[0], X[1])
                : fmt::format("({:g}, {:g}, {:g})", X[0], X[1], X[D - 1]);
}

/// Calls f(X, weight) for the Gauss points of one cell.
template <int D, class F>
void for_gauss_points(const Grid<D>& grid, Index cell, const TensorRule<D>& rule, F&& f) {
  const auto corners = grid.corner_points(at(grid.cells, cell));
  for (std::size_t q = 0; q < rule.x.size(); ++q) {
    const CellPoint<D, D> p = cell_point(corners, grid.bulge(cell), rule.x[q]);
    f(p.X, rule.w[q] * determinant<D>(p.J));
  }
}

}  // namespace

template <int D>
void find_boundary(Grid<D>& grid) {
  struct Side {
    std::array<Index, (1 << (D - 1))> key;  // ascending nodes
    Index cell;
    int side;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  for (Index e = 0; e < grid.cell_count(); ++e)
    for (int side = 0; side < 2 * D; ++side) {
      Side s{{}, e, side};
      const auto local = side_corners<D>(side);
      for (std::size_t a = 0; a < local.size(); ++a) s.key[a] = at(at(grid.cells, e), local[a]);
      std::sort(s.key.begin(), s.key.end());
      sides.push_back(s);
    }
  std::sort(sides.begin(), sides.end());

  grid.facets.clear();
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].key == sides[i].key) ++end;
    if (end - i > 2)
      throw InputError(fmt::format("the grid is not conforming: cells {}, {} and {} share one side",
                                   sides[i].cell, sides[i + 1].cell, sides[i + 2].cell));
    if (end - i == 1) {
      Facet<D> facet;
      facet.cell = sides[i].cell;
      facet.side = sides[i].side;
      const auto local = side_corners<D>(facet.side);
      for (std::size_t a = 0; a < local.size(); ++a)
        facet.nodes[a] = at(at(grid.cells, facet.cell), local[a]);
      grid.facets.push_back(facet);
    }
    i = end;
  }
  std::sort(grid.facets.begin(), grid.facets.end(), [](const Facet<D>& a, const Facet<D>& b) {
    return std::pair(a.cell, a.side) < std::pair(b.cell, b.side);
  });
}

template <int D>
std::optional<CellPoint<D, D>> find_fold(const Grid<D>& grid, Index cell) {
  constexpr int points = D == 2 ? 9 : 27;
  const auto corners = grid.corner_points(at(grid.cells, cell));
  for (int q = 0; q < points; ++q) {
    Vec<D> xi;
    for (int k = 0, rest = q; k < D; ++k, rest /= 3) xi[k] = rest % 3 - 1;
    const CellPoint<D, D> point = cell_point(corners, grid.bulge(cell), xi);
    if (!(determinant<D>(point.J) > 0)) return point;
  }
  return {};
}

template <int D>
void check_jacobians(const Grid<D>& grid, const std::string& cause) {
  for (Index e = 0; e < grid.cell_count(); ++e)
    if (const auto fold = find_fold(grid, e))
      throw InputError(
          fmt::format("{} folds cell {} at {}: its Jacobian is {:g} there, but must be positive",
                      cause, e, place<D>(fold->X), determinant<D>(fold->J)));
}

template <int D>
NodeCells cells_of_nodes(const Grid<D>& grid) {
  NodeCells result;
  result.row.assign(grid.X.size() + 1, 0);
  for (const auto& cell : grid.cells)
    for (const Index node : cell) ++at(result.row, node + 1);
  std::partial_sum(result.row.begin(), result.row.end(), result.row.begin());
  result.entry.resize(static_cast<std::size_t>(result.row.back()));
  std::vector<Offset> next(result.row.begin(), result.row.end() - 1);
  for (Index e = 0; e < grid.cell_count(); ++e)
    for (int a = 0; a < Grid<D>::corners; ++a)
      at(result.entry, at(next, at(at(grid.cells, e), a))++) = {e, a};
  return result;
}

template <int D>
Real volume(const Grid<D>& grid) {
  // det J has degree 2 per direction, 2 D - 1 where the cell is curved.
  const TensorRule<D> straight = tensor_rule<D>(2), curved = tensor_rule<D>(D);
  Real sum = 0;
  for (Index e = 0; e < grid.cell_count(); ++e)
    for_gauss_points(grid, e, grid.bulge(e) ? curved : straight,
                     [&](const Vec<D>&, Real weight) { sum += weight; });
  return sum;
}

template <int D>
Real mean_spacing(const Grid<D>& grid) {
  return std::pow(volume(grid) / grid.cell_count(), 1.0 / D);
}

template <int D>
Mat<D> mean_stretch(const Grid<D>& grid) {
  Mat<D> squares = Mat<D>::Zero();
  for (Index e = 0; e < grid.cell_count(); ++e) {
    const auto corners = grid.corner_points(at(grid.cells, e));
    const Mat<D> J = cell_point<D>(corners, grid.bulge(e), Vec<D>::Zero()).J;
    squares += J * J.transpose();
  }
  const Mat<D> U = square_root<D>(squares / std::pow(determinant<D>(squares), 1.0 / D));
  return U.isApprox(Mat<D>::Identity(), 1e-9) ? Mat<D>(Mat<D>::Identity()) : U;
}

template <int D>
std::vector<Index> boundary_nodes(const Grid<D>& grid) {
  std::vector<Index> nodes;
  for (const auto& facet : grid.facets)
    nodes.insert(nodes.end(), facet.nodes.begin(), facet.nodes.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

template <int D>
std::vector<std::array<Index, D>> triangulate_boundary(const Grid<D>& grid) {
  std::vector<std::array<Index, D>> simplices;
  for (const auto& facet : grid.facets) {
    const auto& v = facet.nodes;
    if constexpr (D == 2) {
      simplices.push_back(v);
    } else {
      const auto X = [&](int a) -> const Vec<3>& { return at(grid.X, at(v, a)); };
      if ((X(0) - X(3)).squaredNorm() <= (X(1) - X(2)).squaredNorm()) {
        simplices.push_back({v[0], v[1], v[3]});
        simplices.push_back({v[0], v[3], v[2]});
      } else {
        simplices.push_back({v[0], v[1], v[2]});
        simplices.push_back({v[1], v[3], v[2]});
      }
    }
  }
  return simplices;
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
      points.weight.push_back(weight);
    });
  return points;
}

#define MENISCUS_INSTANTIATE(D)                                                       \
  template void find_boundary(Grid<D>&);                                              \
  template void check_jacobians(const Grid<D>&, const std::string&);                  \
  template std::optional<CellPoint<D, D>> find_fold<D>(const Grid<D>&, Index);        \
  template NodeCells cells_of_nodes<D>(const Grid<D>&);                               \
  template Real volume(const Grid<D>&);                                               \
  template Real mean_spacing(const Grid<D>&);                                         \
  template Mat<D> mean_stretch(const Grid<D>&);                                       \
  template std::vector<Index> boundary_nodes(const Grid<D>&);                         \
  template std::vector<std::array<Index, D>> triangulate_boundary<D>(const Grid<D>&); \
  template CellPoints<D> cell_gauss_points(const Grid<D>&, int);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
