// SPDX-License-Identifier: BSD-3-Clause
// The kinds of cells in mesh files, by their numbers in Gmsh and in VTK.
#pragma once
#include "body/mesh/mesh_file.hpp"

#include <optional>

namespace meniscus {

/// Properties of one kind of cell.
struct MeshKind {
  MeshShape shape;
  int nodes;  ///< number of nodes; corners come first
  int corners;
  /// middles[m]: the corners between which node corners + m lies. Empty for a node in the middle of
  /// the cell.
  std::vector<std::vector<int>> middles;
};

/// The kind of cell with this number. Empty if the number is unknown or means a point. Throws
/// InputError (without a place) for kinds that are known but not supported.
std::optional<MeshKind> gmsh_kind(long number);
std::optional<MeshKind> vtk_kind(long number);

/// Returns the corners of a cell and adds its middle nodes to `data`.
MeshCell mesh_cell(const MeshKind& kind, const std::vector<Index>& nodes, std::string where,
                   MeshData& data);

}  // namespace meniscus
