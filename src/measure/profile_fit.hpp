// SPDX-License-Identifier: BSD-3-Clause
// The contact angle of any free surface: a profile of Young and Laplace fitted to its points.
#pragma once
#include "numbers/types.hpp"

#include <vector>

namespace meniscus {

/// A wall of constant curvature: a point of its surface on the axis of the profile, the normal
/// into the liquid there, and the curvature, 1/radius of a ball, -1/radius of a cavity, or 0.
template <int D>
struct WallFrame {
  Vec<D> point, normal;
  Real curvature;
};

/// Contact angles in radians along the line of a drop.
struct LineAngles {
  Real mean;   ///< over all directions from the axis
  Real front;  ///< in a given direction
  Real rear;   ///< in the opposite direction
  Real error;  ///< root mean square distance of the surface from the fit / height of its points
};

/// Fits a surface that ends on a wall to points of a free surface, weighted by area. It is a
/// surface of revolution about the normal of the wall (2D: a line that is symmetric about it). The
/// sum of its curvatures is p - bond z at the height z above the point of the wall. Small changes
/// of it vary with the direction phi from the axis as cos phi, sin phi, cos 2 phi and sin 2 phi
/// (2D: they are opposite on both sides). They have the same p, or add a gradient of p along the
/// wall. phi counts from `along`, a unit vector normal to the normal. Derivation: wetting note 2.
template <int D>
LineAngles fit_profile(const std::vector<Vec<D>>& x, const std::vector<Real>& area,
                       const WallFrame<D>& wall, Real bond, const Vec<D>& along);

}  // namespace meniscus
