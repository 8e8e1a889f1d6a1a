// SPDX-License-Identifier: BSD-3-Clause
// Makes a body from unit shape and map.
#include "body/shapes/geometry.hpp"

#include "meniscus/error.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace meniscus {

namespace {

/// The patch on which all nodes of the facet lie.
template <int D>
int find_patch(const Grid<D>& unit, const Facet<D>& facet,
               const std::vector<SurfacePatch<D>>& patches) {
  const Real size = (at(unit.X, facet.nodes.front()) - at(unit.X, facet.nodes.back())).norm();
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const bool on_patch = std::all_of(facet.nodes.begin(), facet.nodes.end(), [&](Index i) {
      return patches[p].distance(at(unit.X, i)) < 1e-8 * size;
    });
    if (on_patch) return static_cast<int>(p);
  }
  throw InputError(fmt::format("side {} of cell {} lies on none of the {} surface patches",
                               facet.side, facet.cell, patches.size()));
}

/// The corners of a facet at the ends of edge 2 t + upper, along which facet direction t is
/// constant.
std::array<int, 2> edge_corners(int edge) {
  const int t = edge / 2, fixed = (edge % 2) << t, along = 1 << (1 - t);
  return {fixed, fixed | along};
}

void find_patches_beyond(Grid<3>& grid) {
  struct Edge {
    std::array<Index, 2> nodes;  // ascending
    std::size_t facet;
    int edge;
  };
  std::vector<Edge> edges;
  for (std::size_t f = 0; f < grid.facets.size(); ++f)
    for (int edge = 0; edge < 4; ++edge) {
      const auto local = edge_corners(edge);
      const Index a = at(grid.facets[f].nodes, local[0]), b = at(grid.facets[f].nodes, local[1]);
      edges.push_back({{std::min(a, b), std::max(a, b)}, f, edge});
    }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Edge& a, const Edge& b) { return a.nodes < b.nodes; });
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const Edge &a = edges[i], &b = edges[i + 1];
    if (a.nodes != b.nodes) continue;
    at(grid.facets[a.facet].patch_beyond, a.edge) = grid.facets[b.facet].patch;
    at(grid.facets[b.facet].patch_beyond, b.edge) = grid.facets[a.facet].patch;
  }
}

template <int D>
void move_nodes(const SmoothMap<D>& map, Grid<D>& grid) {
  parallel_for(static_cast<Index>(grid.X.size()), [&](Index A) {
    Vec<D>& X = at(grid.X, A);
    X = map(X).x;
  });
}

}  // namespace

template <int D>
Geometry<D> make_geometry(Grid<D> unit, std::vector<SurfacePatch<D>> patches, bool smooth,
                          SmoothMap<D> map) {
  find_boundary(unit);
  for (auto& facet : unit.facets) facet.patch = find_patch(unit, facet, patches);
  if constexpr (D == 3) find_patches_beyond(unit);
  auto surface = std::make_shared<MappedPatches<D>>(unit.X, std::move(patches), smooth, map);
  Geometry<D> geometry{std::move(unit), std::move(surface)};
  move_nodes(map, geometry.grid);
  curve_boundary(geometry);
  check_jacobians(geometry.grid, "the shape");
  return geometry;
}

template <int D>
Geometry<D> apply_map(const SmoothMap<D>& map, Geometry<D> geometry) {
  move_nodes(map, geometry.grid);
  geometry.surface = geometry.surface->mapped(map, geometry.grid);
  curve_boundary(geometry);
  check_jacobians(geometry.grid, "the map");
  return geometry;
}

#define MENISCUS_INSTANTIATE(D)                                                                  \
  template Geometry<D> make_geometry(Grid<D>, std::vector<SurfacePatch<D>>, bool, SmoothMap<D>); \
  template Geometry<D> apply_map(const SmoothMap<D>&, Geometry<D>);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
