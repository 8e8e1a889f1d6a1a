// SPDX-License-Identifier: BSD-3-Clause
// Measures of drops on walls: wetted area, contact angle, height.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "physics/contact/bent_line.hpp"

#include <functional>
#include <vector>

namespace meniscus {

/// The contact line at a motion.
using LineAt = std::function<BentLine(const Motion&)>;

/// Measures of the contact line around a wetted area energy / adhesion (2D: length):
///
/// - base_radius: radius of a disk of this area (2D: half the length), plus BentLine::beyond.
/// - line_speed: its rate, by a central difference over 1e-4 of the radius.
template <int D>
std::vector<MeasureSource> front_measures(std::function<Real(const Motion&)> wetted_area,
                                          LineAt line);

/// The contact angle in radians of a spherical cap (2D: circular segment) with this volume (area)
/// and height above a plane.
template <int D>
Real angle_of_cap(Real volume, Real height);

/// Height of a point above a wall, and the curvature at this point of the surface at that height.
/// The curvature is 0 above a plane, 1/r at the distance r from the centre of a ball, -1/r in a
/// cavity.
struct WallHeight {
  Real height, curvature;
};
template <int D>
using HeightAbove = std::function<WallHeight(const Vec<D>& x, Real time)>;

/// Measures of a drop on a wall of constant curvature.
///
/// - film: mean height of the surface that is nearer than `film_gap`; the smallest height if
///   nothing is so near. The surface of contact lies below it by the depth of the line.
/// - contact_angle: degrees between the surface of contact and the sphere (2D: circle) that fits
///   the drop best above 0.35 of its height; 180 if they do not meet.
/// - height: height of the apex of this sphere above the surface of contact.
/// - contact_angle_vh, on a plane: contact angle in degrees of the cap with this height and the
///   volume of the drop and of the gap below its film.
///
/// The surface has 6 Gauss points per facet direction and is built at the first evaluation (wetting
/// note 2).
template <int D>
std::vector<MeasureSource> cap_measures(const Body<D>& body, HeightAbove<D> height_of,
                                        Real film_gap, LineAt line, bool flat);

}  // namespace meniscus
