// SPDX-License-Identifier: BSD-3-Clause
// Cells of mesh files: their number of nodes and the positions of these.
#include "body/mesh/mesh_cells.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

using Middles = std::vector<std::vector<int>>;

const Middles line_middles{{0, 1}}, triangle_middles{{0, 1}, {1, 2}, {2, 0}},
    square_middles{{0, 1}, {1, 2}, {2, 3}, {3, 0}},
    gmsh_tetrahedron{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {2, 3}, {1, 3}},
    vtk_tetrahedron{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
    gmsh_hexahedron{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                    {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}},
    vtk_hexahedron{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                   {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
    gmsh_sides{{0, 1, 2, 3}, {0, 1, 5, 4}, {0, 3, 7, 4}, {1, 2, 6, 5}, {3, 2, 6, 7}, {4, 5, 6, 7}},
    vtk_sides{{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};

/// Joins the lists of middles of edges and of sides. `middle`: the cell also has a node in its
/// middle, which no surface uses.
Middles joined_middles(Middles edges, const Middles& sides, bool middle) {
  edges.insert(edges.end(), sides.begin(), sides.end());
  if (middle) edges.emplace_back();
  return edges;
}

MeshKind kind_of(MeshShape shape, Middles middles = {}) {
  constexpr std::array<int, 5> corners{2, 3, 4, 4, 8};
  const int count = at(corners, static_cast<int>(shape));
  return {shape, count + static_cast<int>(middles.size()), count, std::move(middles)};
}

[[noreturn]] void refuse_kind_of_cell(const std::string& name) {
  throw InputError(fmt::format(
      "is a {}; expected are hexahedra or tetrahedra (2D: quadrilaterals or triangles) of first or "
      "second order, as gmsh -order 1 or -order 2 gives them",
      name));
}

}  // namespace

std::optional<MeshKind> gmsh_kind(long number) {
  using enum MeshShape;
  switch (number) {
    case 1:
      return kind_of(line);
    case 2:
      return kind_of(triangle);
    case 3:
      return kind_of(quadrilateral);
    case 4:
      return kind_of(tetrahedron);
    case 5:
      return kind_of(hexahedron);
    case 8:
      return kind_of(line, line_middles);
    case 9:
      return kind_of(triangle, triangle_middles);
    case 10:
      return kind_of(quadrilateral, joined_middles(square_middles, {{0, 1, 2, 3}}, false));
    case 11:
      return kind_of(tetrahedron, gmsh_tetrahedron);
    case 12:
      return kind_of(hexahedron, joined_middles(gmsh_hexahedron, gmsh_sides, true));
    case 16:
      return kind_of(quadrilateral, square_middles);
    case 17:
      return kind_of(hexahedron, gmsh_hexahedron);
    case 15:
      return {};
    case 6:
    case 13:
    case 18:
      refuse_kind_of_cell("prism");
    case 7:
    case 14:
    case 19:
      refuse_kind_of_cell("pyramid");
    default:
      refuse_kind_of_cell(fmt::format("cell of Gmsh's type {}", number));
  }
}

std::optional<MeshKind> vtk_kind(long number) {
  using enum MeshShape;
  switch (number) {
    case 3:
      return kind_of(line);
    case 5:
      return kind_of(triangle);
    case 9:
      return kind_of(quadrilateral);
    case 10:
      return kind_of(tetrahedron);
    case 12:
      return kind_of(hexahedron);
    case 21:
      return kind_of(line, line_middles);
    case 22:
      return kind_of(triangle, triangle_middles);
    case 23:
      return kind_of(quadrilateral, square_middles);
    case 24:
      return kind_of(tetrahedron, vtk_tetrahedron);
    case 25:
      return kind_of(hexahedron, vtk_hexahedron);
    case 28:
      return kind_of(quadrilateral, joined_middles(square_middles, {{0, 1, 2, 3}}, false));
    case 29:
      return kind_of(hexahedron, joined_middles(vtk_hexahedron, vtk_sides, true));
    case 1:
      return {};
    case 13:
    case 26:
    case 32:
      refuse_kind_of_cell("wedge");
    case 14:
    case 27:
      refuse_kind_of_cell("pyramid");
    default:
      refuse_kind_of_cell(fmt::format("cell of VTK's type {}", number));
  }
}

MeshCell mesh_cell(const MeshKind& kind, const std::vector<Index>& nodes, std::string where,
                   MeshData& data) {
  MeshCell cell{kind.shape, {nodes.begin(), nodes.begin() + kind.corners}, std::move(where), {}};
  std::vector<Index> sorted = cell.corners;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    throw InputError("has a corner twice; expected are different ones");
  for (std::size_t m = 0; m < kind.middles.size(); ++m) {
    std::vector<Index> between;
    for (const int corner : kind.middles[m]) between.push_back(at(cell.corners, corner));
    if (between.empty()) continue;
    std::sort(between.begin(), between.end());
    data.middles.insert_or_assign(between, at(nodes, kind.corners + static_cast<int>(m)));
  }
  return cell;
}

}  // namespace meniscus
