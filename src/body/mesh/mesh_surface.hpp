// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of meshes: smooth pieces between sharp edges, their names, and curves or patches through
// the nodes.
#pragma once
#include "body/shapes/geometry.hpp"

#include <map>
#include <string>
#include <vector>

namespace meniscus {

/// Surface data and regions of a mesh file; keys are ascending node numbers of the grid.
template <int D>
struct MeshSurface {
  std::map<std::vector<Index>, Vec<D>> middle;     ///< middles of edges and (3D) of quadrilaterals
  std::map<std::vector<Index>, std::string> face;  ///< names of facets
  std::vector<std::string> regions;                ///< names; empty: none
  std::vector<int> region_of;                      ///< [cell] number of its region
};

enum class MeshFacets { curved, flat };

/// The body of a grid (X and cells). Where the surface is smooth and cells are of first order, its
/// surface is recovered from the nodes. Otherwise it consists of quadratic patches. They go through
/// the middles of the file, if there are any; else through middles recovered for each smooth piece
/// and for the curves between pieces. Pieces end where facets meet at more than 50 degrees. Edges
/// of cells that would fold stay straight; with MeshFacets::flat all edges do. Faces have the names
/// of the file; without names, "surface", or "face_1", "face_2" ... for several pieces. Throws
/// InputError if a cell folds.
template <int D>
Geometry<D> mesh_geometry(Grid<D> grid, const MeshSurface<D>& given,
                          MeshFacets facets = MeshFacets::curved);

}  // namespace meniscus
