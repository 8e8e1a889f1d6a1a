// SPDX-License-Identifier: BSD-3-Clause
// Reference director: the axis of an anisotropic material at each point of its reference.
#pragma once
#include "meniscus/body/geometry.hpp"
#include "meniscus/core/input.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// `reference_director`: formulas of the reference position, one per dimension, of any length; left
/// out, the normal of the walls of a shape that has walls.
class ReferenceDirector {
 public:
  static constexpr const char* key = "reference_director";

  /// Notes problems in the block. `dimension` components are required.
  ReferenceDirector(const Block& block, int dimension);

  /// Whether all points have the same director.
  bool uniform() const;
  /// The unit vector at X. Throws InputError if the shape has no walls, or the formulas have no
  /// direction at X.
  template <int D>
  Eigen::Vector3d at(const Vec<D>& X, const Geometry<D>& geometry) const;

 private:
  std::vector<Expression> formulas_;  ///< empty: by the geometry
  std::string place_;                 ///< in the scene, to begin messages with
};

/// Largest angle in radians between the unit directors of two nodes that share an edge of a cell;
/// h and -h are the same director.
template <int D>
Real largest_turn(const Grid<D>& grid, std::span<const Eigen::Vector3d> director);

/// A sentence if a director that is constant in every nodal cell, but turns by so much from one to
/// the next, changes energies by 0.5 % or more: its square varies by turn^2/12 within a cell.
std::optional<std::string> doubt_of_director(Real turn);

}  // namespace meniscus
