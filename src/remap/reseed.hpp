// SPDX-License-Identifier: BSD-3-Clause
// Reseeding: evenly spaced node positions for a body in its present configuration.
#pragma once
#include "body/body.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace meniscus {

/// Node positions of a body for its next reference.
template <int D>
struct Seeds {
  std::vector<Vec<D>> nodes;  ///< [particle]
  /// Points of the surface patches, numbered as in PatchNodes. If empty, the surface is recovered
  /// from the nodes.
  std::vector<Vec<D>> surface;

  Seeds(std::vector<Vec<D>> at = {}) : nodes(std::move(at)) {}
};

/// The line at which the surface of a body leaves a wall: where `gap` passes `level`.
template <int D>
struct ContactLine {
  std::function<Real(const Vec<D>& x, Real t)> gap;
  Real level;
};

/// Evenly spaced node positions for the cells of a body in its present configuration (wetting note
/// 9). Surface nodes move along the surface to the middle of the facets around them, and closer
/// together where the surface is strongly curved. Nodes on edges stay on the edges; if there is a
/// contact line, a ring of nodes lies on it. The new surface consists of the patches that fit the
/// present patches best, and encloses the same volume. Interior nodes follow by a harmonic map from
/// `ideal`, the grid that the scene makes for this body. `u` has the displacement coefficients of
/// the body. Throws SolveError if shape functions cannot be built.
template <int D>
Seeds<D> reseeded(const Body<D>& body, const NodalVector* u, const Grid<D>& ideal,
                  const std::optional<ContactLine<D>>& line, Real time);

}  // namespace meniscus
