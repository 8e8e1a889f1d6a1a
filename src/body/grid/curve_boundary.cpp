// SPDX-License-Identifier: BSD-3-Clause
// Curved boundary cells: deviations of the exact surface from the middles of edges and facets.
#include "body/grid/simplex.hpp"
#include "body/surface/surface_points.hpp"
#include "numbers/buckets.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>
#include <vector>

namespace meniscus {

namespace {

/// An edge of the reference facet: its corners and its middle. In 2D the facet is the edge.
template <int D>
struct FacetEdge {
  std::array<int, 2> corners{0, 1};
  Vec<D - 1> middle = Vec<D - 1>::Zero();
};

template <int D>
std::vector<FacetEdge<D>> facet_edges() {
  if constexpr (D == 2) {
    return {FacetEdge<2>{}};
  } else {
    std::vector<FacetEdge<3>> edges;
    for (int across = 0; across < 2; ++across)
      for (int upper = 0; upper < 2; ++upper) {
        const int corner = upper << across;
        edges.push_back({{corner, corner | (1 << (1 - across))},
                         corner_sign(corner, across) * Vec<2>::Unit(across)});
      }
    return edges;
  }
}

bool is_rounding(Real deviation, Real length) {
  return deviation < 1e-9 * length;
}

/// Deviations of boundary edges: the exact middle minus the straight one.
template <int D>
class EdgeDeviations {
 public:
  explicit EdgeDeviations(const Geometry<D>& geometry) {
    const Grid<D>& grid = geometry.grid;
    const auto edges = facet_edges<D>();
    begin_ = sort_into_buckets<Offset>(
        static_cast<Index>(grid.X.size()),
        [&](auto&& f) {
          for (const auto& facet : grid.facets)
            for (const auto& edge : edges) {
              const auto [a, b] =
                  std::minmax({at(facet.nodes, edge.corners[0]), at(facet.nodes, edge.corners[1])});
              if (a != b) f(a, Edge{b, &facet, edge.middle});  // a triangle repeats a node
            }
        },
        [&](Offset count) { edges_.resize(static_cast<std::size_t>(count)); },
        [&](Offset k, const Edge& edge) { at(edges_, k) = edge; });
    parallel_for(static_cast<Index>(grid.X.size()), [&](Index a) {
      const std::span<Edge> from_a = at_node(a);
      for (Edge& edge : from_a) {
        // The first of the facets that share the edge gives its middle.
        if (&edge != &*std::find_if(from_a.begin(), from_a.end(),
                                    [&](const Edge& first) { return first.end == edge.end; }))
          continue;
        const Vec<D>&A = at(grid.X, a), &B = at(grid.X, edge.end);
        edge.deviation = surface_point(geometry, *edge.facet, edge.middle) - 0.5 * (A + B);
        edge.curved = !is_rounding(edge.deviation.norm(), (A - B).norm());
      }
    });
  }

  /// The deviation of the edge between two nodes. Null if it is straight or not on the boundary.
  const Vec<D>* find(Index a, Index b) const {
    for (const Edge& edge : at_node(std::min(a, b)))
      if (edge.curved && edge.end == std::max(a, b)) return &edge.deviation;
    return nullptr;
  }

  /// [node] 1 if the node is an end of a curved edge.
  std::vector<char> ends() const {
    std::vector<char> is_end(begin_.size() - 1, 0);
    for (Index a = 0; a < static_cast<Index>(is_end.size()); ++a)
      for (const Edge& edge : at_node(a))
        if (edge.curved) at(is_end, a) = at(is_end, edge.end) = 1;
    return is_end;
  }

 private:
  /// A boundary edge at its node of lower number, once for each facet. `curved` is set for one of
  /// these.
  struct Edge {
    Index end;
    const Facet<D>* facet;
    Vec<D - 1> middle;
    Vec<D> deviation = Vec<D>::Zero();
    bool curved = false;
  };

  std::span<const Edge> at_node(Index a) const {
    return {edges_.data() + at(begin_, a), edges_.data() + at(begin_, a + 1)};
  }
  std::span<Edge> at_node(Index a) {
    return {edges_.data() + at(begin_, a), edges_.data() + at(begin_, a + 1)};
  }

  std::vector<Offset> begin_;  // [node]
  std::vector<Edge> edges_;
};

/// The bulge of a simplex: its first columns are the deviations for edge_functions().
template <int D>
Bulge<D> bulge_of_simplex(const typename Grid<D>::Cell& cell, const EdgeDeviations<D>& deviations,
                          const std::vector<char>& at_curved_edge) {
  Bulge<D> bulge;
  Eigen::Index e = 0;
  for (const auto& [i, j] : simplex_edges<D>()) {
    const Index a = at(cell, at(simplex_corners<D>(), i)),
                b = at(cell, at(simplex_corners<D>(), j));
    if (at(at_curved_edge, a) && at(at_curved_edge, b))
      if (const Vec<D>* deviation = deviations.find(a, b)) {
        bulge.deviation.col(e) = *deviation;
        bulge.curved = (1u << D) - 1;
      }
    ++e;
  }
  return bulge;
}

template <int D>
Bulge<D> bulge_of_edges(const typename Grid<D>::Cell& cell, const EdgeDeviations<D>& deviations,
                        const std::vector<char>& at_curved_edge) {
  Bulge<D> bulge;
  for (int m = 0; m < Bulge<D>::mode_count; ++m) {
    const auto [along, upper] = at(Bulge<D>::modes, m);
    if (std::popcount(along) != 1) continue;
    const Index a = at(cell, upper), b = at(cell, upper | along);
    if (!at(at_curved_edge, a) || !at(at_curved_edge, b)) continue;
    if (const Vec<D>* deviation = deviations.find(a, b)) bulge.add(m, *deviation);
  }
  return bulge;
}

/// Adds the deviation of a facet: its exact centre minus the centre of the cell with curved edges.
void add_facet(const Geometry<3>& geometry, const Facet<3>& facet, Bulge<3>& bulge) {
  const int k = facet.side / 2;
  const BulgeMode wanted{7u & ~(1u << k), unsigned(facet.side % 2) << k};
  const auto& modes = Bulge<3>::modes;
  const auto mode = std::find_if(modes.begin(), modes.end(), [&](const BulgeMode& m) {
    return m.along == wanted.along && m.upper == wanted.upper;
  });
  const auto corners = geometry.grid.corner_points(at(geometry.grid.cells, facet.cell));
  const Vec<3> centre = (facet.side % 2 ? 1 : -1) * Vec<3>::Unit(k);
  const Vec<3> deviation =
      surface_point<3>(geometry, facet, Vec<2>::Zero()) - cell_point<3>(corners, &bulge, centre).X;
  const Vec<3> diagonal = at(geometry.grid.X, facet.nodes[3]) - at(geometry.grid.X, facet.nodes[0]);
  if (!is_rounding(deviation.norm(), diagonal.norm()))
    bulge.add(static_cast<int>(mode - modes.begin()), deviation);
}

}  // namespace

template <int D>
void curve_boundary(Geometry<D>& geometry) {
  Grid<D>& grid = geometry.grid;
  grid.bulges.clear();
  const EdgeDeviations<D> deviations(geometry);
  const std::vector<char> at_curved_edge = deviations.ends();

  struct AtBoundary {
    Index cell;
    std::span<const Facet<D>> facets;
    Bulge<D> bulge = {};
  };
  std::vector<AtBoundary> cells;
  auto facet = grid.facets.begin();  // facets are ordered by cell
  for (Index e = 0; e < grid.cell_count(); ++e) {
    const auto first = facet;
    while (facet != grid.facets.end() && facet->cell == e) ++facet;
    const auto& cell = at(grid.cells, e);
    if (facet != first ||
        std::any_of(cell.begin(), cell.end(), [&](Index A) { return at(at_curved_edge, A) != 0; }))
      cells.push_back({e, {first, facet}});
  }
  parallel_for(static_cast<Index>(cells.size()), [&](Index k) {
    auto& [e, facets, bulge] = at(cells, k);
    const auto& cell = at(grid.cells, e);
    const bool simplex = is_simplex<D>(cell);
    bulge = simplex ? bulge_of_simplex<D>(cell, deviations, at_curved_edge)
                    : bulge_of_edges<D>(cell, deviations, at_curved_edge);
    if constexpr (D == 3)
      if (!simplex)
        for (const Facet<3>& of_cell : facets) add_facet(geometry, of_cell, bulge);
  });

  grid.bulge_of.assign(grid.cells.size(), -1);
  grid.bulges.reserve(cells.size());
  for (const AtBoundary& at_boundary : cells) {
    if (!at_boundary.bulge.curved) continue;
    at(grid.bulge_of, at_boundary.cell) = static_cast<Index>(grid.bulges.size());
    grid.bulges.push_back(at_boundary.bulge);
  }
  if (grid.bulges.empty()) grid.bulge_of.clear();
}

template void curve_boundary(Geometry<2>&);
template void curve_boundary(Geometry<3>&);

}  // namespace meniscus
