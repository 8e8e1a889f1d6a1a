// SPDX-License-Identifier: BSD-3-Clause
// Finer meshes: all edges of a mesh are halved.
#pragma once
#include "body/mesh/mesh_surface.hpp"

namespace meniscus {

/// A mesh before its surface is known, as mesh_geometry() takes it.
template <int D>
struct MeshParts {
  Grid<D> grid;  ///< X and cells
  MeshSurface<D> given;
};

/// The mesh of a body with all edges halved, so that it has 2^D times as many cells. `body` is the
/// result of mesh_geometry() for `given`, and has the same numbers of nodes and cells.
///
/// A triangle is divided into four triangles, a tetrahedron into four at its corners and an
/// octahedron, which is cut into four along its shortest diagonal; quadrilaterals and hexahedra are
/// divided at the middles of edges, sides and cells. New nodes have their places in the curved
/// cells. Old nodes keep their numbers. Facets keep the names of the faces of the body, and cells
/// their regions. If the surface consists of quadratic patches, the middles of the new edges at it
/// lie on the same patches, so that the body stays the same.
template <int D>
MeshParts<D> halved(const Geometry<D>& body, const MeshSurface<D>& given);

}  // namespace meniscus
