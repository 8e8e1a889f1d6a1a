// SPDX-License-Identifier: BSD-3-Clause
// Meridians of closed surfaces of revolution about z that are symmetric in z, by arc length.
#pragma once
#include "numbers/types.hpp"

#include <functional>

namespace meniscus {

/// A point of the upper half of a meridian: its position (r, z), its outward normal (sin psi, cos
/// psi), and derivatives with respect to the arc length.
struct MeridianPoint {
  Real r, z;
  Real sin_psi, cos_psi;
  Real curvature;        ///< psi'
  Real curvature_slope;  ///< psi'', 0 where the curvature jumps
};

struct Meridian {
  Real length = 0;           ///< from the pole (s = 0) to the equator
  Real smallest_radius = 0;  ///< smallest radius of curvature; limits parallel surfaces inside
  std::function<MeridianPoint(Real s)> point;
  /// Outward unit normal (r, z) of the parallel surface through a position with r, z >= 0 that lies
  /// less than smallest_radius inside.
  std::function<Vec<2>(const Vec<2>& place)> normal;
};

/// A cylinder whose edges are rounded by quarter circles. With edge_radius = height / 2 it is a
/// disk with a semicircular rim; with height / 2 = radius as well, a sphere. Needs 0 < edge_radius
/// <= height / 2 and edge_radius <= radius.
Meridian rounded_cylinder_meridian(Real radius, Real height, Real edge_radius);

/// An ellipse with the semi-axes `radius` and height / 2.
Meridian spheroid_meridian(Real radius, Real height);

}  // namespace meniscus
