// SPDX-License-Identifier: BSD-3-Clause
// Quality numbers of the meshes of a scene, printed by `meniscus check`.
#include "app/mesh_report.hpp"

#include "app/print.hpp"
#include "body/grid/simplex.hpp"
#include "body/mesh/mesh_regions.hpp"
#include "body/surface/surface_points.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <vector>

namespace meniscus {
namespace {

template <int D>
const char* kind_of_cells(const Grid<D>& grid) {
  const bool simplices = is_simplex<D>(grid.cells.front());
  if (D == 3) return simplices ? "tetrahedra" : "hexahedra";
  return simplices ? "triangles" : "quadrilaterals";
}

/// Number of surface edges (2D: surface nodes) that do not belong to exactly two facets. Zero for a
/// closed surface.
template <int D>
Index open_edges(const Grid<D>& grid) {
  std::map<std::vector<Index>, int> facets;
  for (const Facet<D>& facet : grid.facets)
    for (std::size_t a = 0; a < facet.nodes.size(); ++a) {
      std::vector<Index> ends{at(facet.nodes, a)};
      // Neighbours around the facet, whose nodes are in tensor order. One edge of a triangle has no
      // length.
      if (D == 3) ends.push_back(at(facet.nodes, at(std::array<int, 4>{1, 3, 0, 2}, a)));
      std::sort(ends.begin(), ends.end());
      if (D == 2 || ends.front() != ends.back()) ++facets[ends];
    }
  return static_cast<Index>(std::count_if(facets.begin(), facets.end(),
                                          [](const auto& edge) { return edge.second != 2; }));
}

}  // namespace

template <int D>
void say_meshes(const Scene<D>& scene, const SceneInput& input) {
  const std::vector<Block> blocks = input.root().tables("body");
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].text("shape", "") != "mesh") continue;
    const Body<D>& body = at(scene.system.bodies, b);
    const Grid<D>& grid = body.geometry.grid;
    Real area = 0, enclosed = 0;
    const SurfacePoints<D> points = surface_points(body.geometry, 3);
    for (Index q = 0; q < points.size(); ++q) {
      area += at(points.area, q);
      enclosed += at(points.area, q) * (at(points.X, q) - grid.X.front()).dot(at(points.N, q)) / D;
    }
    const std::vector<Real> sums = shape_integrals(body);
    Real least_cell = unbounded, least_sum = unbounded, volume = 0;
    for (Index A = 0; A < body.size(); ++A) {
      least_cell = std::min(least_cell, body.cells.volume(A));
      least_sum = std::min(least_sum, at(sums, A) / body.cells.volume(A));
      volume += body.cells.volume(A);
    }
    const Index open = open_edges(grid);
    say("body '{}': {} {} of a mesh, surface {}, with {} {:.6g} and {} {:.6g} within; that of the "
        "cells {:.6g}\n",
        body.name, grid.cell_count(), kind_of_cells(grid),
        open == 0 ? "closed" : fmt::format("with {} edges that have not two facets", open),
        D == 3 ? "area" : "length", area, D == 3 ? "volume" : "area", enclosed, volume);
    say("body '{}': the smallest nodal cell has {:.3g} of the mean {}, the smallest row sum {:.3g} "
        "of its cell{}\n",
        body.name, least_cell * body.size() / volume, D == 3 ? "volume" : "area", least_sum,
        least_sum < 0.3 ? ", which the floor of the masses raises to 0.3" : "");
    if (const MeshRegions* regions = mesh_regions(body.geometry))
      for (std::size_t r = 0; r < regions->names.size(); ++r)
        say("body '{}': region '{}' has {} cells\n", body.name, regions->names[r],
            regions->cells[r]);
  }
}

template void say_meshes(const Scene<2>&, const SceneInput&);
template void say_meshes(const Scene<3>&, const SceneInput&);

}  // namespace meniscus
