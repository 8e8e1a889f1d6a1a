// SPDX-License-Identifier: BSD-3-Clause
// Mesh files: Gmsh's .msh (ASCII, versions 2.2 and 4.1) and VTK's .vtu (ASCII or inline base64).
#pragma once
#include "numbers/types.hpp"

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

enum class MeshShape { line, triangle, quadrilateral, tetrahedron, hexahedron };

/// A cell of the body, or an element of fewer dimensions.
struct MeshCell {
  MeshShape shape;
  std::vector<Index> corners;  ///< in the order of VTK
  std::string where;           ///< "line 17: element 5" or "cell 4", for messages
  std::string group;  ///< name of its physical group, or empty: a face or a region of the body
};

struct MeshData {
  std::vector<Eigen::Vector3d> X;
  std::vector<MeshCell> cells;
  /// Middle nodes of edges and sides of second-order cells; the key has the corners in ascending
  /// order.
  std::map<std::vector<Index>, Index> middles;
};

/// Reads a file. Throws InputError, "FILE: ...", if it does not exist or its name does not end in
/// .msh or .vtu.
std::string text_of_mesh_file(const std::string& path);

/// Parses the text of a mesh file. The extension of `path` determines the format. Throws
/// InputError: "FILE: line or cell: the problem; the expected content".
MeshData read_mesh(std::string_view text, const std::string& path);

/// Parsers of the two formats. `name` is the begin of their messages.
MeshData read_msh(std::string_view text, const std::string& name);
MeshData read_vtu(std::string_view text, const std::string& name);

}  // namespace meniscus
