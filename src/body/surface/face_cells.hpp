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

/// Facets of the boundary: of the face of that name (empty: of all), where the formula of the
/// reference place, taken in the middle of their quarters, is not zero.
struct FaceChoice {
  std::string face;
  std::optional<Expression> where;
};

/// A face cell k is what the outer facets of a nodal cell have in common with a face; facets on
/// different patches are different face cells. Its points are those that make the gradients of
/// the integration rule "q_scni".
template <int D>
struct FaceCells {
  std::vector<Index> cell;       ///< [k] number of the nodal cell, which is that of its particle
  std::vector<Real> area;        ///< [k] in 2D length
  std::vector<Vec<D>> normal;    ///< [k] mean outward normal; of unit length on a plane
  std::vector<Vec<D>> centre;    ///< [k] mean place
  std::vector<Offset> begin{0};  ///< points of k: [begin[k], begin[k + 1])
  std::vector<Vec<D>> X, N;      ///< [point] place, outward unit normal
  std::vector<Real> share;       ///< [point] of the area of its face cell; they sum to one
  PointRows<D> mean;             ///< [k] means of N_A
  /// A quarter (2D: half) of a facet that is chosen: the one at a node of the grid.
  struct Part {
    Index facet, node;
  };
  std::vector<Part> parts;

  Index size() const { return static_cast<Index>(cell.size()); }
  Real total_area() const;
};

/// Throws InputError if nothing is chosen, SolveError where shape functions cannot be determined.
template <int D>
FaceCells<D> face_cells(const Body<D>& body, const FaceChoice& choice);

/// Names of the faces of a body with the number of facets on each, in the order of their patches.
template <int D>
std::vector<std::pair<std::string, Index>> face_names(const Geometry<D>& geometry);

}  // namespace meniscus
