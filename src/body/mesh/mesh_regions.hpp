// SPDX-License-Identifier: BSD-3-Clause
// Regions of meshes: parts that may have materials of their own.
#pragma once
#include "body/shapes/geometry.hpp"

#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// The physical volumes (2D: surfaces) of a mesh file, as parts of the nodal cells.
struct MeshRegions {
  std::vector<std::string> names;  ///< "" for cells without a name
  std::vector<Index> cells;        ///< [region] number of its cells
  std::vector<Real> share;         ///< [node][region] of the volume of the nodal cell

  /// The shares of the regions in a nodal cell; they sum to one.
  std::span<const Real> at_node(Index node) const {
    return std::span(share).subspan(static_cast<std::size_t>(node) * names.size(), names.size());
  }
};

/// Volumes of the regions in the nodal cells, relative to the volume of the cell. `region_of` is
/// the number of the region of each cell.
template <int D>
MeshRegions regions_of_cells(const Grid<D>& grid, std::vector<std::string> names,
                             const std::vector<int>& region_of);

/// The regions of a body; null if its shape has none.
template <int D>
const MeshRegions* mesh_regions(const Geometry<D>& geometry);

}  // namespace meniscus
