// SPDX-License-Identifier: BSD-3-Clause
// The boundary of grids, and checks of their cells.
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

#define MENISCUS_INSTANTIATE(D)                                                \
  template void find_boundary(Grid<D>&);                                       \
  template void check_jacobians(const Grid<D>&, const std::string&);           \
  template std::optional<CellPoint<D, D>> find_fold<D>(const Grid<D>&, Index); \
  template NodeCells cells_of_nodes<D>(const Grid<D>&);                        \
  template std::vector<Index> boundary_nodes(const Grid<D>&);                  \
  template std::vector<std::array<Index, D>> triangulate_boundary<D>(const Grid<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
