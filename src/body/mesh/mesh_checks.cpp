// SPDX-License-Identifier: BSD-3-Clause
// Checks of a mesh: sides that cells share, nodes inside of cells, edges through facets.
#include "body/mesh/mesh_checks.hpp"

#include "body/grid/simplex.hpp"
#include "kernel/neighbor_search.hpp"
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace meniscus {
namespace {

/// A side of a cell with its nodes in the order of a facet; a triangle repeats its last node.
template <int D>
struct CellSide {
  std::array<Index, (1 << (D - 1))> sorted, nodes;
  Index cell;
  auto operator<=>(const CellSide&) const = default;
};

template <int D>
class MeshChecks {
 public:
  using CellName = std::function<std::string(Index)>;

  MeshChecks(const Grid<D>& grid, const CellName& name) : grid_(grid), name_(name) {
    for (Index e = 0; e < grid.cell_count(); ++e) add_sides(e);
    std::sort(sides_.begin(), sides_.end());
    shared_.resize(grid.cells.size() * Grid<D>::corners);
    std::iota(shared_.begin(), shared_.end(), Index{0});
    part_.resize(grid.cells.size());
    std::iota(part_.begin(), part_.end(), Index{0});
  }

  void require_simple_body() {
    std::vector<CellSide<D>> surface;
    for (std::size_t i = 0, end; i < sides_.size(); i = end) {
      end = i + 1;
      while (end < sides_.size() && sides_[end].sorted == sides_[i].sorted) ++end;
      if (end - i > 2)
        refuse(fmt::format(
            "{}, {} and {} have one side in common, of which there are two sides "
            "only: cells overlap",
            name_(sides_[i].cell), name_(sides_[i + 1].cell), name_(sides_[i + 2].cell)));
      if (end - i == 2)
        join(sides_[i], sides_[i + 1]);
      else
        surface.push_back(sides_[i]);
    }
    require_joined();
    require_nothing_inside();
    require_no_crossing(surface);
    require_one_part();
  }

 private:
  [[noreturn]] static void refuse(const std::string& what) {
    throw InputError(what + "; expected are cells that share whole sides and fill the body once");
  }

  bool simplex(Index e) const { return is_simplex<D>(at(grid_.cells, e)); }
  /// Number of different corners of a cell; corner(e, i) is the place of the i-th of them in the
  /// cell.
  int corner_count(Index e) const { return simplex(e) ? D + 1 : Grid<D>::corners; }
  int corner(Index e, int i) const { return simplex(e) ? at(simplex_corners<D>(), i) : i; }
  Index node(Index e, int i) const { return at(at(grid_.cells, e), corner(e, i)); }
  const Vec<D>& X(Index node) const { return at(grid_.X, node); }

  Vec<D> middle(Index e) const {
    Vec<D> sum = Vec<D>::Zero();
    for (int i = 0; i < corner_count(e); ++i) sum += X(node(e, i));
    return sum / corner_count(e);
  }

  void add_sides(Index e) {
    for (int side = 0; side < (simplex(e) ? D + 1 : 2 * D); ++side) {
      CellSide<D> own{{}, {}, e};
      std::size_t count = 0;
      for (int i = 0; i < corner_count(e); ++i)
        if (simplex(e) ? i != side : ((i >> (side / 2)) & 1) == side % 2)
          own.nodes[count++] = node(e, i);
      std::fill(own.nodes.begin() + static_cast<std::ptrdiff_t>(count), own.nodes.end(),
                own.nodes[count - 1]);
      own.sorted = own.nodes;
      std::sort(own.sorted.begin(), own.sorted.begin() + static_cast<std::ptrdiff_t>(count));
      std::fill(own.sorted.begin() + static_cast<std::ptrdiff_t>(count), own.sorted.end(),
                own.sorted[count - 1]);
      sides_.push_back(own);
    }
  }

  /// Joins the corners of two cells at their common side.
  void join(const CellSide<D>& one, const CellSide<D>& other) {
    Vec<D> m = Vec<D>::Zero(), normal;
    for (const Index n : one.nodes) m += X(n) / Real(one.nodes.size());
    if constexpr (D == 2)
      normal = Vec<2>(X(one.nodes[1])[1] - m[1], m[0] - X(one.nodes[1])[0]);
    else
      normal = cross(X(one.nodes[3]) - X(one.nodes[0]), X(one.nodes[2]) - X(one.nodes[1]));
    const Real a = normal.dot(middle(one.cell) - m), b = normal.dot(middle(other.cell) - m);
    if (!((a < 0) != (b < 0)))
      refuse(
          fmt::format("{} and {} lie on the same side of the facet that they share: they overlap",
                      name_(one.cell), name_(other.cell)));
    for (const Index n : one.nodes) unite(shared_, entry(one.cell, n), entry(other.cell, n));
    unite(part_, one.cell, other.cell);
  }

  /// Number of node n as a corner of cell e, counted over the corners of all cells.
  Index entry(Index e, Index n) const {
    const auto& cell = at(grid_.cells, e);
    const auto found = std::find(cell.begin(), cell.end(), n);
    return e * Grid<D>::corners + static_cast<Index>(found - cell.begin());
  }
  /// The least number of the set that a number belongs to; `other` has another one of the set.
  static Index root(std::vector<Index>& other, Index number) {
    while (at(other, number) != number) {
      at(other, number) = at(other, at(other, number));
      number = at(other, number);
    }
    return number;
  }
  static void unite(std::vector<Index>& other, Index a, Index b) {
    const Index first = root(other, a), second = root(other, b);
    at(other, std::max(first, second)) = std::min(first, second);
  }

  /// Throws InputError if cells at a node are not connected through common sides.
  void require_joined() {
    std::vector<Index> first(grid_.X.size(), -1);
    for (Index e = 0; e < grid_.cell_count(); ++e)
      for (int i = 0; i < corner_count(e); ++i) {
        const Index n = node(e, i), own = root(shared_, entry(e, n));
        Index& of_node = at(first, n);
        if (of_node < 0) of_node = own;
        if (of_node != own)
          refuse(
              fmt::format("{} and {} have a node in common, but no sides of cells join them "
                          "there: parts of the body meet in {} only",
                          name_(of_node / Grid<D>::corners), name_(e),
                          D == 3 ? "an edge or a corner" : "a corner"));
      }
  }

  /// Kernels reach across a narrow gap between two parts of a body as if there were none.
  void require_one_part() {
    constexpr int most = 4;
    int count = 0;
    std::string places;
    for (Index e = 0; e < grid_.cell_count(); ++e) {
      if (root(part_, e) != e) continue;
      if (++count > most) continue;
      const Vec<D> X = middle(e);
      places += fmt::format("{}{} at ({:.6g}, {:.6g}{})", count > 1 ? ", " : "", name_(e), X[0],
                            X[1], D == 3 ? fmt::format(", {:.6g}", X[D - 1]) : "");
    }
    if (count > 1)
      throw InputError(fmt::format(
          "the cells are {} parts that do not touch each other, with {}{}; expected is one "
          "part: give each part a file and a [[body]] of its own",
          count, places, count > most ? ", ..." : ""));
  }

  /// True if x lies inside a cell, farther from its sides than rounding errors.
  bool is_inside(Index e, const Vec<D>& x) const {
    constexpr Real margin = 1e-7;
    const auto corners = grid_.corner_points(at(grid_.cells, e));
    if (simplex(e)) {
      Mat<D> edges;
      for (int k = 0; k < D; ++k) edges.col(k) = X(node(e, k + 1)) - X(node(e, 0));
      const Vec<D> share = inverse<D>(edges) * (x - X(node(e, 0)));
      return share.minCoeff() > margin && share.sum() < 1 - margin;
    }
    Vec<D> xi = Vec<D>::Zero();
    for (int step = 0; step < 20; ++step) {  // steps of Newton's method
      const CellPoint<D, D> p = multilinear<D, D>(corners, xi);
      const Vec<D> change = inverse<D>(p.J) * (x - p.X);
      xi += change;
      if (!(xi.cwiseAbs().maxCoeff() < 3)) return false;
      if (change.norm() < 1e-10) return xi.cwiseAbs().maxCoeff() < 1 - margin;
    }
    return false;
  }

  void require_nothing_inside() const {
    std::vector<Vec<D>> places = grid_.X;
    for (Index e = 0; e < grid_.cell_count(); ++e) places.push_back(middle(e));
    const NeighborSearch<D> search(places);
    parallel_for(grid_.cell_count(), [&](Index e) {
      Real radius = 0;
      const Vec<D> m = middle(e);
      for (int i = 0; i < corner_count(e); ++i)
        radius = std::max(radius, (X(node(e, i)) - m).norm());
      std::vector<Index> near;
      search.within_unsorted(m, radius, near);
      const auto& cell = at(grid_.cells, e);
      for (const Index k : near) {
        const Index other = k - grid_.node_count();
        const bool own =
            other < 0 ? std::find(cell.begin(), cell.end(), k) != cell.end() : other == e;
        if (own || !is_inside(e, at(places, k))) continue;
        if (other < 0)
          refuse(fmt::format("{} has a node of other cells inside of it: cells overlap", name_(e)));
        refuse(
            fmt::format("the middle of {} is inside of {}: they overlap", name_(other), name_(e)));
      }
    });
  }

  /// An edge of the surface (2D: a facet).
  struct SurfaceEdge {
    Index a, b, cell;
  };

  /// Throws InputError if an edge pierces a side. Edges are sorted by the power of two of their
  /// length, so that the search radius for short edges stays small.
  void require_no_crossing(const std::vector<CellSide<D>>& surface) const {
    std::map<int, std::vector<SurfaceEdge>> edges;
    for (const CellSide<D>& side : surface)
      for (std::size_t i = 0; i < side.nodes.size(); ++i) {
        // Neighbours around the facet, whose nodes are stored in tensor order.
        const Index a = side.nodes[i],
                    b = side.nodes[D == 2 ? 1 - i : at(std::array<std::size_t, 4>{1, 3, 0, 2}, i)];
        if (a != b) edges[std::ilogb((X(a) - X(b)).norm())].push_back({a, b, side.cell});
      }
    for (const auto& of_length : edges) {
      const int length = of_length.first;
      const std::vector<SurfaceEdge>& alike = of_length.second;
      std::vector<Vec<D>> middles;
      for (const SurfaceEdge& edge : alike) middles.push_back(0.5 * (X(edge.a) + X(edge.b)));
      const NeighborSearch<D> search(middles);
      parallel_for(static_cast<Index>(surface.size()), [&](Index s) {
        const CellSide<D>& side = at(surface, s);
        Vec<D> m = Vec<D>::Zero();
        for (const Index n : side.nodes) m += X(n) / Real(side.nodes.size());
        Real radius = 0;
        for (const Index n : side.nodes) radius = std::max(radius, (X(n) - m).norm());
        std::vector<Index> near;
        search.within_unsorted(m, radius + std::ldexp(1.0, length), near);
        for (const Index k : near)
          if (const SurfaceEdge& edge = at(alike, k); crosses(edge, side))
            refuse(
                fmt::format("the surface goes through itself: an edge of {} through a side of {}",
                            name_(edge.cell), name_(side.cell)));
      });
    }
  }

  /// True if an edge pierces the interior of a side. A quadrilateral need not be plane: the edge
  /// has to pierce it for both ways of cutting it into triangles.
  bool crosses(const SurfaceEdge& edge, const CellSide<D>& side) const {
    for (const Index n : side.nodes)
      if (n == edge.a || n == edge.b) return false;
    if constexpr (D == 2) {
      return apart(side.nodes[0], side.nodes[1], edge.a, edge.b) &&
             apart(edge.a, edge.b, side.nodes[0], side.nodes[1]);
    } else {
      const auto& n = side.nodes;
      if (n[2] == n[3]) return crosses_triangle(edge, n[0], n[1], n[2]);
      return (crosses_triangle(edge, n[0], n[1], n[2]) ||
              crosses_triangle(edge, n[1], n[3], n[2])) &&
             (crosses_triangle(edge, n[0], n[1], n[3]) || crosses_triangle(edge, n[0], n[3], n[2]));
    }
  }

  /// True if c and d lie on different sides of the line from a to b.
  bool apart(Index a, Index b, Index c, Index d) const {
    const Vec<D> along = X(b) - X(a);
    const auto beside = [&](Index n) {
      const Vec<D> r = X(n) - X(a);
      return (along[0] * r[1] - along[1] * r[0]) / along.squaredNorm();
    };
    return signs(beside(c), beside(d)) < 0;
  }

  /// 1 if both numbers have the same sign, -1 if they have different signs, 0 if one is zero up to
  /// rounding.
  static int signs(Real a, Real b) {
    constexpr Real rounding = 1e-9;
    if (!(std::abs(a) > rounding) || !(std::abs(b) > rounding)) return 0;
    return (a < 0) == (b < 0) ? 1 : -1;
  }

  bool crosses_triangle(const SurfaceEdge& edge, Index a, Index b, Index c) const requires(D == 3) {
    const Vec<3> normal = cross(X(b) - X(a), X(c) - X(a)), along = X(edge.b) - X(edge.a);
    const Real size = std::pow(normal.norm(), 1.5), length = along.norm();
    if (signs(normal.dot(X(edge.a) - X(a)) / size, normal.dot(X(edge.b) - X(a)) / size) >= 0)
      return false;
    // Signed volume of the edge and an edge p-q of the triangle. The line pierces the triangle if
    // all three have one sign.
    const auto around = [&](Index p, Index q) {
      return along.dot(cross(X(p) - X(edge.a), X(q) - X(edge.a))) / (normal.norm() * length);
    };
    const Real ab = around(a, b), bc = around(b, c), ca = around(c, a);
    return signs(ab, bc) > 0 && signs(bc, ca) > 0;
  }

  const Grid<D>& grid_;
  const CellName& name_;
  std::vector<CellSide<D>> sides_;
  std::vector<Index> shared_;  ///< [corner of a cell] another corner of the same set
  std::vector<Index> part_;    ///< [cell] another one of its part
};

}  // namespace

template <int D>
void require_simple_body(const Grid<D>& grid, const std::function<std::string(Index)>& name) {
  MeshChecks<D>(grid, name).require_simple_body();
}

template void require_simple_body(const Grid<2>&, const std::function<std::string(Index)>&);
template void require_simple_body(const Grid<3>&, const std::function<std::string(Index)>&);

}  // namespace meniscus
