// SPDX-License-Identifier: BSD-3-Clause
// The kinds of cells that mesh files know, by the numbers of Gmsh and of VTK.
#pragma once
#include "body/mesh/mesh_file.hpp"

#include <optional>

namespace meniscus {

/// What is known of a kind of cell.
struct MeshKind {
  MeshShape shape;
  int nodes;  ///< corners first
  int corners;
  /// Corners that node corners + m is in the middle of; those in the middle of the cell have none.
  std::vector<std::vector<int>> middles;
};

/// By number; nothing: it is not known, or it is a point. Throws InputError, without a place, for
/// kinds that bodies cannot be made of.
std::optional<MeshKind> gmsh_kind(long number);
std::optional<MeshKind> vtk_kind(long number);

/// The corners of a cell and, into the data, its middles.
MeshCell mesh_cell(const MeshKind& kind, const std::vector<Index>& nodes, std::string where,
                   MeshData& data);

}  // namespace meniscus
