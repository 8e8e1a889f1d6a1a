// SPDX-License-Identifier: BSD-3-Clause
// Boundary, checks, volumes and Gauss points of grids.
#include "body/grid/grid.hpp"

#include "body/grid/gauss.hpp"
#include "body/grid/octant_tables.hpp"
#include "body/grid/simplex.hpp"
#include "meniscus/error.hpp"
#include "numbers/buckets.hpp"
#include "numbers/dense.hpp"
#include "parallel/divided.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace meniscus {

namespace {

/// The corners of a side of the reference cell, in the tensor order of an outward facet.
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

/// The nodes around a side of a cell. A triangle of a collapsed cell has three, with the last one
/// repeated. A side that is no side of the simplex has less than D.
template <int D>
struct SideNodes {
  std::array<Index, (1 << (D - 1))> node;
  int count = 0;  ///< number of different nodes

  SideNodes(const typename Grid<D>::Cell& cell, int side) {
    const auto local = side_corners<D>(side);
    const auto end = [&] { return node.begin() + count; };
    for (std::size_t a = 0; a < local.size(); ++a) {
      const Index next = at(cell, at(local, a ^ (a >> 1)));
      if (std::find(node.begin(), end(), next) == end()) at(node, count++) = next;
    }
    std::fill(end(), node.end(), at(node, count - 1));
  }
};

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

}  // namespace

template <int D>
void find_boundary(Grid<D>& grid) {
  struct Side {
    std::array<Index, (1 << (D - 1))> nodes;  // ascending; a triangle has the last one twice
    Index cell;
    int side;
    auto operator<=>(const Side&) const = default;
  };
  constexpr Index sides_per_cell = 2 * D;
  std::vector<Side> sides;
  const std::vector<Offset> begin = sort_into_buckets<Offset>(
      static_cast<Index>(grid.X.size()),
      [&](auto&& f) {
        for (Index e = 0; e < grid.cell_count(); ++e)
          for (int side = 0; side < sides_per_cell; ++side) {
            auto [nodes, count] = SideNodes<D>(at(grid.cells, e), side);
            if (count < D) continue;
            std::sort(nodes.begin(), nodes.begin() + count);
            std::fill(nodes.begin() + count, nodes.end(), at(nodes, count - 1));
            f(nodes.front(), Side{nodes, e, side});
          }
      },
      [&](Offset count) { sides.resize(static_cast<std::size_t>(count)); },
      [&](Offset k, const Side& side) { at(sides, k) = side; });

  std::vector<char> is_facet(grid.cells.size() * sides_per_cell, 0);
  parallel_for(static_cast<Index>(grid.X.size()), [&](Index node) {
    const auto of_node =
        std::span(sides).subspan(static_cast<std::size_t>(at(begin, node)),
                                 static_cast<std::size_t>(at(begin, node + 1) - at(begin, node)));
    std::sort(of_node.begin(), of_node.end());
    for (std::size_t i = 0, end; i < of_node.size(); i = end) {
      const auto& [nodes, cell, side] = of_node[i];
      end = i + 1;
      while (end < of_node.size() && of_node[end].nodes == nodes) ++end;
      if (end - i > 2)
        throw InputError(
            fmt::format("the grid is not conforming: cells {}, {} and {} share one side", cell,
                        of_node[i + 1].cell, of_node[i + 2].cell));
      if (end - i == 1) at(is_facet, cell * sides_per_cell + side) = 1;
    }
  });

  grid.facets.clear();
  for (std::size_t k = 0; k < is_facet.size(); ++k) {
    if (!is_facet[k]) continue;
    Facet<D> facet;
    facet.cell = static_cast<Index>(k) / sides_per_cell;
    facet.side = static_cast<int>(k) % sides_per_cell;
    const auto nodes = SideNodes<D>(at(grid.cells, facet.cell), facet.side).node;
    for (std::size_t a = 0; a < nodes.size(); ++a) facet.nodes[a] = nodes[a ^ (a >> 1)];
    if (grid.revolved && std::all_of(facet.nodes.begin(), facet.nodes.end(),
                                     [&](Index node) { return at(grid.X, node)[0] == 0; }))
      continue;  // on the axis
    grid.facets.push_back(facet);
  }
}

namespace {

/// Checks the corners of the parts of the simplex.
template <int D>
std::optional<CellPoint<D, D>> find_fold_of_simplex(const Grid<D>& grid, Index cell) {
  const auto corners = grid.corner_points(at(grid.cells, cell));
  for (int i = 0; i <= D; ++i)
    for (int a = 0; a < (1 << D); ++a) {
      Vec<D> xi;
      for (int k = 0; k < D; ++k) xi[k] = corner_sign(a, k);
      const CellPoint<D, D> point =
          simplex_point<D>(corners, grid.bulge(cell), part_shares<D>(i, xi));
      if (!(determinant<D>(point.J) > 0)) return point;
    }
  return {};
}

}  // namespace

template <int D>
std::optional<CellPoint<D, D>> find_fold(const Grid<D>& grid, Index cell) {
  if (is_simplex<D>(at(grid.cells, cell))) return find_fold_of_simplex(grid, cell);
  static const std::vector<TabulatedPoint<D>> lattice = [] {
    std::vector<TabulatedPoint<D>> points;
    for (int q = 0; q < (D == 2 ? 9 : 27); ++q) {
      Vec<D> xi;
      for (int k = 0, rest = q; k < D; ++k, rest /= 3) xi[k] = rest % 3 - 1;
      points.push_back(tabulate<D>(xi, 0));
    }
    return points;
  }();
  const CellMap<D> map(grid, cell);
  for (const auto& p : lattice) {
    const CellPoint<D, D> point = map(p);
    if (!(determinant<D>(point.J) > 0)) return point;
  }
  return {};
}

template <int D>
void check_jacobians(const Grid<D>& grid, const std::string& cause) {
  const OwnItems own = evenly.own_items(grid.cell_count());
  on_each_rank([&] {
    parallel_for(own, [&](Index e) {
      if (const auto fold = find_fold(grid, e))
        throw InputError(
            fmt::format("{} folds cell {} at {}: its Jacobian is {:g} there, but must be positive",
                        cause, e, place<D>(fold->X), determinant<D>(fold->J)));
    });
  });
}

template <int D>
NodeCells cells_of_nodes(const Grid<D>& grid) {
  NodeCells result;
  // A corner of the simplex counts once, though a collapsed cell repeats it.
  const auto is_node_of = [](const typename Grid<D>::Cell& cell, int a) {
    return !is_simplex<D>(cell) || at(simplex_corners<D>(), simplex_corner<D>(a)) == a;
  };
  result.row = sort_into_buckets<Offset>(
      static_cast<Index>(grid.X.size()),
      [&](auto&& f) {
        for (Index e = 0; e < grid.cell_count(); ++e)
          for (int a = 0; a < Grid<D>::corners; ++a)
            if (const auto& cell = at(grid.cells, e); is_node_of(cell, a))
              f(at(cell, a), NodeCells::Entry{e, a});
      },
      [&](Offset count) { result.entry.resize(static_cast<std::size_t>(count)); },
      [&](Offset k, const NodeCells::Entry& entry) { at(result.entry, k) = entry; });
  return result;
}

namespace {

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
      if (v[2] == v[3]) {
        simplices.push_back({v[0], v[1], v[2]});
        continue;
      }
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
      points.weight.push_back(weight * circle(grid, X));
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
  template std::vector<Real> diagonals_around_nodes(const Grid<D>&, const Mat<D>&);   \
  template std::vector<Real> supports_by_cells(const Grid<D>&, const Mat<D>&, Real);  \
  template std::vector<Index> boundary_nodes(const Grid<D>&);                         \
  template std::vector<std::array<Index, D>> triangulate_boundary<D>(const Grid<D>&); \
  template CellPoints<D> cell_gauss_points(const Grid<D>&, int);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
