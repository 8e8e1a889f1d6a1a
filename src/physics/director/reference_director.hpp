// SPDX-License-Identifier: BSD-3-Clause
// Reference director: the axis of an anisotropic material at each point of the reference.
#pragma once
#include "body/shapes/geometry.hpp"
#include "input/input.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// `reference_director`: formulas of the reference position, one per dimension, of any length. By
/// default the normal of the wall, for shapes that have walls.
class ReferenceDirector {
 public:
  static constexpr const char* key = "reference_director";

  /// Notes problems in the block. `dimension` components are required.
  ReferenceDirector(const Block& block, int dimension);

  /// True if all points have the same director.
  bool uniform() const;
  /// The unit vector at X. Throws InputError if the shape has no walls, or if the formulas vanish
  /// at X.
  template <int D>
  Eigen::Vector3d at(const Vec<D>& X, const Geometry<D>& geometry) const;

 private:
  std::vector<Expression> formulas_;  ///< empty: from the geometry
  std::string place_;                 ///< in the scene, to begin messages with
};

/// The largest angle in radians between the unit directors of two nodes that share an edge of a
/// cell. h and -h are the same director.
template <int D>
Real largest_turn(const Grid<D>& grid, std::span<const Eigen::Vector3d> director);

/// A warning if the director turns by so much between nodal cells that energies change by 0.5 % or
/// more. It is constant in each cell, and its square varies by turn^2/12 within a cell.
std::optional<std::string> doubt_of_director(Real turn);

}  // namespace meniscus
