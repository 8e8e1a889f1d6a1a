// SPDX-License-Identifier: BSD-3-Clause
// Even places for the nodes of a body in its present configuration.
#pragma once
#include "body/body.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace meniscus {

/// Where the nodes of a body are to be in its next reference.
template <int D>
struct Seeds {
  std::vector<Vec<D>> nodes;  ///< [particle]
  /// By the numbers of PatchNodes: the surface is patches through them. Empty: it is recovered
  /// from the nodes.
  std::vector<Vec<D>> surface;

  Seeds(std::vector<Vec<D>> at = {}) : nodes(std::move(at)) {}
};

/// Where the surface of a body leaves a wall: where `gap` passes `level`.
template <int D>
struct ContactLine {
  std::function<Real(const Vec<D>& x, Real t)> gap;
  Real level;
};

/// The cells of the body with their nodes evenly in its present configuration (wetting note 9):
/// those of the surface are moved along it to the middles of what is around them, closer together
/// where it is bent; nodes on edges stay on them, or a ring of them lies on the contact line, if
/// there is one; the surface is that
/// of patches which fit the present ones best, and encloses the same volume; those inside follow by
/// a harmonic map from `ideal`, the same cells as the scene makes them. `u` is that of the body.
/// Throws SolveError if shape functions cannot be built.
template <int D>
Seeds<D> reseeded(const Body<D>& body, const NodalVector* u, const Grid<D>& ideal,
                  const std::optional<ContactLine<D>>& line, Real time);

}  // namespace meniscus
