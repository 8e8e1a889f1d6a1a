// SPDX-License-Identifier: BSD-3-Clause
// Divides each cell and each boundary facet of a mesh at the middles of its edges.
#include "body/mesh/mesh_subdivision.hpp"

#include "body/grid/simplex.hpp"
#include "body/mesh/mesh_pieces.hpp"
#include "body/surface/surface_points.hpp"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {
namespace {

/// Adds the cells, facets and nodes of the finer mesh.
template <int D>
class Halving {
 public:
  Halving(const Geometry<D>& body, const MeshSurface<D>& given)
      : body_(body), grid_(body.grid), recovered_(body.surface->smooth() && given.middle.empty()) {
    fine_.grid.X = grid_.X;
    fine_.given.regions = given.regions;
    for (Index e = 0; e < grid_.cell_count(); ++e) {
      if (is_simplex<D>(at(grid_.cells, e)))
        divide_simplex(e);
      else
        divide_tensor_cell(e);
      if (!given.regions.empty())
        fine_.given.region_of.resize(fine_.grid.cells.size(), at(given.region_of, e));
    }
    for (const Facet<D>& facet : grid_.facets) {
      if constexpr (D == 3) {
        if (facet.nodes[2] == facet.nodes[3]) {
          divide_triangle(facet);
          continue;
        }
      }
      divide_tensor_facet(facet);
    }
  }

  MeshParts<D> parts() && { return std::move(fine_); }

 private:
  /// The node between these nodes of the coarse mesh, in ascending order. It is made at place() if
  /// it does not exist.
  template <class Place>
  Index node_between(MeshKey nodes, Place&& place) {
    if (nodes.size() == 1) return nodes.front();
    const auto [found, is_new] = number_.try_emplace(std::move(nodes), fine_.grid.node_count());
    if (is_new) fine_.grid.X.push_back(place());
    return found->second;
  }

  void divide_simplex(Index e) {
    const auto& cell = at(grid_.cells, e);
    const auto points = grid_.corner_points(cell);
    const auto corner = [&](int i) { return at(cell, at(simplex_corners<D>(), i)); };
    const auto middle = [&](int i, int j) {
      return node_between(mesh_key({corner(i), corner(j)}), [&]() -> Vec<D> {
        Shares<D> shares;
        shares.value[i] = shares.value[j] = 0.5;
        return simplex_point<D>(points, grid_.bulge(e), shares).X;
      });
    };
    for (int i = 0; i <= D; ++i) {
      std::array<Index, D + 1> at_corner;
      for (int j = 0; j <= D; ++j) at(at_corner, j) = i == j ? corner(i) : middle(i, j);
      fine_.grid.cells.push_back(collapsed(at_corner));
    }
    if constexpr (D == 2)
      fine_.grid.cells.push_back(
          collapsed(std::array<Index, 3>{middle(0, 1), middle(1, 2), middle(0, 2)}));
    else
      divide_octahedron(
          {middle(0, 1), middle(2, 3), middle(0, 2), middle(0, 3), middle(1, 3), middle(1, 2)});
  }

  /// Cuts the octahedron between the middles 01, 23, 02, 03, 13, 12 of the edges of a tetrahedron
  /// along its shortest diagonal. Of diagonals that are equal but for rounding, the first counts.
  void divide_octahedron(const std::array<Index, 6>& middles) requires(D == 3) {
    // Both ends of each diagonal, then the other corners around it, right-handed.
    constexpr int corners[3][6] = {{0, 1, 2, 3, 4, 5}, {2, 4, 3, 0, 5, 1}, {3, 5, 0, 2, 1, 4}};
    constexpr Real rounding = 1e-9;
    int best = 0;
    Real shortest = 0;
    for (int k = 0; k < 3; ++k) {
      const Real length = (at(fine_.grid.X, at(middles, corners[k][0])) -
                           at(fine_.grid.X, at(middles, corners[k][1])))
                              .norm();
      if (k > 0 && length >= shortest * (1 - rounding)) continue;
      best = k;
      shortest = length;
    }
    const auto node = [&](int i) { return at(middles, corners[best][i]); };
    for (int k = 0; k < 4; ++k)
      fine_.grid.cells.push_back(
          collapsed(std::array<Index, 4>{node(0), node(1), node(2 + k), node(2 + (k + 1) % 4)}));
  }

  void divide_tensor_cell(Index e) {
    const auto& cell = at(grid_.cells, e);
    const auto points = grid_.corner_points(cell);
    const auto node = [&](const Vec<D>& xi) {
      MeshKey around;
      for (int a = 0; a < Grid<D>::corners; ++a)
        if (supports<D>(a, xi)) around.push_back(at(cell, a));
      return node_between(mesh_key(std::move(around)),
                          [&]() -> Vec<D> { return cell_point<D>(points, grid_.bulge(e), xi).X; });
    };
    for (int child = 0; child < Grid<D>::corners; ++child) {
      typename Grid<D>::Cell own;
      for (int a = 0; a < Grid<D>::corners; ++a) at(own, a) = node(corner_of_child<D>(child, a));
      fine_.grid.cells.push_back(own);
    }
  }

  /// True if corner a of a cell or facet is one of those between which the point xi in {-1, 0, 1}^P
  /// lies.
  template <int P>
  static bool supports(int a, const Vec<P>& xi) {
    for (int k = 0; k < P; ++k)
      if (xi[k] * corner_sign(a, k) < 0) return false;
    return true;
  }
  /// Corner a of the part of [-1, 1]^P at the corner `child`.
  template <int P>
  static Vec<P> corner_of_child(int child, int a) {
    Vec<P> xi;
    for (int k = 0; k < P; ++k) xi[k] = 0.5 * (corner_sign(child, k) + corner_sign(a, k));
    return xi;
  }

  /// Notes the name of a new facet with these nodes.
  void name(const Facet<D>& parent, const MeshKey& nodes) {
    const std::string face = body_.surface->face_name(parent.patch);
    if (!face.empty()) fine_.given.face[nodes] = face;
  }
  /// Notes the point of the surface between nodes of a new facet. A surface that is recovered from
  /// the nodes is recovered again from the nodes of the finer mesh.
  void place_middle(const Facet<D>& parent, MeshKey nodes, const Vec<D - 1>& xi) {
    if (recovered_) return;
    fine_.given.middle.try_emplace(std::move(nodes), surface_point(body_, parent, xi));
  }

  void divide_tensor_facet(const Facet<D>& facet) {
    constexpr int P = D - 1, corners = 1 << P;
    const auto node = [&](const Vec<P>& xi) {
      MeshKey around;
      for (int a = 0; a < corners; ++a)
        if (supports<P>(a, xi)) around.push_back(at(facet.nodes, a));
      around = mesh_key(std::move(around));
      return around.size() == 1 ? around.front() : number_.at(around);
    };
    for (int child = 0; child < corners; ++child) {
      std::array<Vec<P>, corners> xi;
      Facet<D> own;
      for (int a = 0; a < corners; ++a) {
        at(xi, a) = corner_of_child<P>(child, a);
        at(own.nodes, a) = node(at(xi, a));
      }
      const MeshKey whole = mesh_key({own.nodes.begin(), own.nodes.end()});
      name(facet, whole);
      place_middle(facet, whole, 0.5 * (xi.front() + xi.back()));
      if constexpr (D == 3)
        for (const auto& [a, b] : {std::pair(0, 1), {1, 3}, {3, 2}, {2, 0}})
          place_middle(facet, mesh_key({at(own.nodes, a), at(own.nodes, b)}),
                       0.5 * (at(xi, a) + at(xi, b)));
    }
  }

  void divide_triangle(const Facet<3>& facet) requires(D == 3) {
    using Corner = std::pair<Index, Vec<3>>;  // a node and its barycentric coordinates
    std::array<Corner, 3> corner, middle;     // middle[i] is opposite to corner[i]
    for (int i = 0; i < 3; ++i) at(corner, i) = {at(facet.nodes, i), Vec<3>::Unit(i)};
    for (int i = 0; i < 3; ++i) {
      const Corner &a = at(corner, (i + 1) % 3), &b = at(corner, (i + 2) % 3);
      at(middle, i) = {number_.at(mesh_key({a.first, b.first})), 0.5 * (a.second + b.second)};
    }
    for (const auto& [a, b, c] : {std::array{corner[0], middle[2], middle[1]},
                                  {corner[1], middle[0], middle[2]},
                                  {corner[2], middle[1], middle[0]},
                                  {middle[0], middle[1], middle[2]}}) {
      name(facet, mesh_key({a.first, b.first, c.first}));
      for (const auto& [p, q] : {std::pair(a, b), {b, c}, {c, a}})
        place_middle(facet, mesh_key({p.first, q.first}),
                     in_collapsed_square(0.5 * (p.second + q.second)));
    }
  }
  /// The point of the square [-1, 1]^2, collapsed to a triangle at its upper end, with these
  /// barycentric coordinates.
  static Vec<2> in_collapsed_square(const Vec<3>& shares) {
    const Real below = shares[0] + shares[1];
    return {below > 0 ? (shares[1] - shares[0]) / below : 0, 2 * shares[2] - 1};
  }

  const Geometry<D>& body_;
  const Grid<D>& grid_;
  bool recovered_;
  std::map<MeshKey, Index> number_;  ///< of the new nodes, by the old nodes that they lie between
  MeshParts<D> fine_;
};

}  // namespace

template <int D>
MeshParts<D> halved(const Geometry<D>& body, const MeshSurface<D>& given) {
  return Halving<D>(body, given).parts();
}

template MeshParts<2> halved(const Geometry<2>&, const MeshSurface<2>&);
template MeshParts<3> halved(const Geometry<3>&, const MeshSurface<3>&);

}  // namespace meniscus
