// SPDX-License-Identifier: BSD-3-Clause
// Measures of a drop with a wetted face: base, height, contact angle, speed of the line.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <functional>
#include <vector>

namespace meniscus {

/// What the measures need to know of the drop beside its surface.
template <int D>
struct WettingDrop {
  Real tension;                                 ///< of the free surface
  std::function<Vec<D>(Real time)> weight;      ///< of the volume inside the patches
  bool other_weight;                            ///< body forces act elsewhere, too
  std::function<Real(const Motion&)> pressure;  ///< of the fluid on the surface
  /// Force on the body by which the wall holds the fluid behind the face.
  std::function<Eigen::Vector3d(const Motion&)> hold;
};

/// Measures of the surface that tension and pressure see (SurfacePatches).
///
/// - wetted_area (2D: wetted_length).
/// - base_radius: of the circle whose area is that inside the contact line, projected along the
///   mean normal of the wetted face (2D: half the distance of its ends).
/// - volume (2D: area of the section), and on planes centroid_height, the distance of its centroid.
/// - height: greatest distance of the surface from the wall.
/// - contact_angle, in degrees, on planes and balls (2D: lines and circles): angle at the wall of
///   the profile of Young and Laplace with this base radius, volume and weight. Not a number if
///   body forces vary in space or are not normal to the plane, if there are any on a round wall, or
///   if there is no such profile.
/// - force_x, force_y, force_z: of the drop on the wall, by pressure, tension and weight.
/// - line_speed: mean speed of the contact line along its normal, positive if the drop spreads.
template <int D>
std::vector<MeasureSource> wetted_measures(const Body<D>& body, const WettedFace<D>& face,
                                           WettingDrop<D> drop);

}  // namespace meniscus
