// SPDX-License-Identifier: BSD-3-Clause
// Meshes of files: Gmsh's .msh (ASCII, versions 2.2 and 4.1) and VTK's .vtu (ASCII, or base64 in
// place).
#pragma once
#include "meniscus/core/types.hpp"

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

enum class MeshShape { line, triangle, quadrilateral, tetrahedron, hexahedron };

/// A cell of the body, or (of a dimension less) a part of its surface that has a name.
struct MeshCell {
  MeshShape shape;
  std::vector<Index> corners;  ///< in the order of VTK
  std::string where;           ///< "line 17: element 5" or "cell 4", for messages
  std::string face;            ///< name of the part of the surface; empty: it has none
};

struct MeshData {
  std::vector<Eigen::Vector3d> X;
  std::vector<MeshCell> cells;
  /// Middles of edges and sides of cells of second order, by their corners in ascending order.
  std::map<std::vector<Index>, Index> middles;
};

/// The content of a file. Throws InputError, "FILE: ...", if there is none or its name has another
/// ending than .msh and .vtu.
std::string text_of_mesh_file(const std::string& path);

/// The mesh in the text of a file of that path, by its ending. Throws InputError: "FILE: line or
/// cell: what was found; what is expected".
MeshData read_mesh(std::string_view text, const std::string& path);

/// The same of either kind; `name` begins messages.
MeshData read_msh(std::string_view text, const std::string& name);
MeshData read_vtu(std::string_view text, const std::string& name);

}  // namespace meniscus
