// SPDX-License-Identifier: BSD-3-Clause
// Face cells: the parts of a face of a body that belong to its nodal cells, and the means of shape
// functions over them (held-faces note 1).
#pragma once
#include "body/body.hpp"
#include "input/expression.hpp"

#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// Selects facets of the boundary. `face` is the name of a face; empty selects all faces. `where`
/// is a formula of the reference position, evaluated in the middle of each quarter (2D: half) of a
/// facet; quarters at which it is zero are left out.
struct FaceChoice {
  std::string face;
  std::optional<Expression> where;
};

/// Face cell k is the part of the boundary of one nodal cell that lies on a chosen face. Parts on
/// different patches are different face cells. The points of face cells are the points that the
/// integration rule "q_scni" uses on the boundary.
template <int D>
struct FaceCells {
  std::vector<Index> cell;       ///< [k] number of the nodal cell and of its particle
  std::vector<Real> area;        ///< [k] area (2D: length)
  std::vector<Vec<D>> normal;    ///< [k] mean outward normal; a unit vector on a plane
  std::vector<Vec<D>> centre;    ///< [k] mean position
  std::vector<Offset> begin{0};  ///< points of k: [begin[k], begin[k + 1])
  std::vector<Vec<D>> X, N;      ///< [point] position, outward unit normal
  std::vector<Real> share;       ///< [point] area divided by the area of its face cell
  PointRows<D> mean;             ///< [k] means of the shape functions N_A
  /// A chosen quarter (2D: half) of a facet: the quarter at grid node `node`.
  struct Part {
    Index facet, node;
  };
  std::vector<Part> parts;

  Index size() const { return static_cast<Index>(cell.size()); }
  Real total_area() const;
};

/// Computes the face cells of the chosen facets. Throws InputError if nothing is chosen, and
/// SolveError where shape functions cannot be determined.
template <int D>
FaceCells<D> face_cells(const Body<D>& body, const FaceChoice& choice);

/// Names of the faces of a body with the number of facets on each, in the order of their patches.
template <int D>
std::vector<std::pair<std::string, Index>> face_names(const Geometry<D>& geometry);

}  // namespace meniscus
