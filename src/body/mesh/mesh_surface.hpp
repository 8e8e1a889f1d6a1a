// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of meshes: pieces between edges, with names, and a curve or a patch through the nodes.
#pragma once
#include "body/shapes/geometry.hpp"

#include <map>
#include <string>
#include <vector>

namespace meniscus {

/// What a file says of the surface, by ascending nodes of the grid.
template <int D>
struct MeshSurface {
  std::map<std::vector<Index>, Vec<D>> middle;     ///< of edges, and (3D) of quadrilaterals
  std::map<std::vector<Index>, std::string> face;  ///< names of facets
};

enum class MeshFacets { curved, flat };

/// The body of a grid (X and cells). Its surface is the recovered one where it is smooth and cells
/// are of first order; otherwise quadratic patches: through the middles that the file has, else
/// through those of each smooth piece recovered by itself, and of the curves between pieces. Pieces
/// end where facets meet at more than 50 degrees. Edges of cells that would fold are straight, and
/// all edges with MeshFacets::flat. Faces have the names of the file; if there are none, "surface",
/// or "face_1", "face_2" ... of the pieces. Throws InputError if a cell folds.
template <int D>
Geometry<D> mesh_geometry(Grid<D> grid, const MeshSurface<D>& given,
                          MeshFacets facets = MeshFacets::curved);

}  // namespace meniscus
