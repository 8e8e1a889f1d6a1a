// SPDX-License-Identifier: BSD-3-Clause
// Volumes of the octants of cells, by region.
#include "body/mesh/mesh_regions.hpp"

#include "body/grid/octant_tables.hpp"
#include "parallel/parallel.hpp"

#include <numeric>
#include <utility>

namespace meniscus {
namespace {

template <int D>
Real octant_volume(const Grid<D>& grid, const NodeCells::Entry& octant) {
  const CellMap<D> map(grid, octant.cell);
  const auto* simplex = map.simplex();
  Real volume = 0;
  for (const auto& p : simplex ? simplex->volume(simplex_corner<D>(octant.corner))
                               : map.table().volume(octant.corner))
    volume += sum(p.w * determinant(map(p).J));
  return volume;
}

}  // namespace

template <int D>
MeshRegions regions_of_cells(const Grid<D>& grid, std::vector<std::string> names,
                             const std::vector<int>& region_of) {
  const std::size_t count = names.size();
  MeshRegions regions{std::move(names), std::vector<Index>(count, 0),
                      std::vector<Real>(grid.X.size() * count, 0.0)};
  for (const int region : region_of) ++at(regions.cells, region);
  const NodeCells octants = cells_of_nodes(grid);
  parallel_for(grid.node_count(), [&](Index node) {
    const auto own =
        std::span(regions.share).subspan(static_cast<std::size_t>(node) * count, count);
    for (const auto& octant : octants.of(node))
      at(own, at(region_of, octant.cell)) += octant_volume(grid, octant);
    const Real volume = std::accumulate(own.begin(), own.end(), 0.0);
    for (Real& share : own) share /= volume;
  });
  return regions;
}

template MeshRegions regions_of_cells(const Grid<2>&, std::vector<std::string>,
                                      const std::vector<int>&);
template MeshRegions regions_of_cells(const Grid<3>&, std::vector<std::string>,
                                      const std::vector<int>&);

}  // namespace meniscus
