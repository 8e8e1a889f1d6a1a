// SPDX-License-Identifier: BSD-3-Clause
// Measures of drops on walls: wetted area, contact angle, height.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "meniscus/physics/partner_registry.hpp"
#include "physics/contact/bent_line.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace meniscus {

/// The contact line at a motion.
using LineAt = std::function<BentLine(const Motion&)>;

/// Measures of the contact line around a wetted area energy / adhesion (2D: length):
///
/// - base_radius: radius of a disk of this area (2D: half the length), plus BentLine::beyond.
/// - line_speed: its rate, by a central difference over 1e-4 of the radius.
std::vector<MeasureSource> front_measures(std::function<Real(const Motion&)> wetted_area,
                                          LineAt line, int space_dimension);

/// The contact angle in radians of a spherical cap (2D: circular segment) with this volume (area)
/// and height above a plane.
template <int D>
Real angle_of_cap(Real volume, Real height);

/// A wall of constant curvature under a drop, and what acts on the drop.
template <int D>
struct DropOnWall {
  /// Height of a point above the wall, the normal, and derivatives of the normal.
  std::function<typename PartnerShape<D>::Foot(const Vec<D>& x, Real time)> foot;
  Real film_gap;   ///< the surface is in contact where it is nearer
  Real clear_gap;  ///< the surface is free where it is farther away
  LineAt line;
  std::function<Vec<D>(Real time)> velocity;  ///< of the wall
  /// Weight of the drop per volume over its surface tension.
  std::function<Vec<D>(Real time)> bond;
  bool flat;
  /// Distances from all walls that the drop touches.
  std::shared_ptr<const std::vector<std::function<Real(const Vec<D>& x, Real time)>>> walls;
};

/// Measures of a drop on a wall of constant curvature.
///
/// - film: mean height of the surface that is in contact; the smallest height if nothing is. The
///   surface of contact lies below it by the depth of the line.
/// - contact_angle: degrees between the surface of contact and the sphere (2D: circle) that fits
///   the drop best above 0.35 of its height; 180 if they do not meet.
/// - height: height of the apex of this sphere above the surface of contact.
/// - contact_angle_vh, on a plane: contact angle in degrees of the cap with this height and the
///   volume of the drop and of the gap below its film.
///
/// The surface has 6 Gauss points per facet direction and is built at the first evaluation (wetting
/// note 2).
template <int D>
std::vector<MeasureSource> cap_measures(const Body<D>& body, const DropOnWall<D>& wall);

/// Contact angles in degrees of any free surface that ends on the wall, by fit_profile(). Points of
/// the free surface are farther from all walls than 0.3 of its height over this one. Angles are 180
/// without contact, or without such points. The surface has 3 Gauss points per facet direction, in
/// 2D 6.
///
/// - contact_angle: mean along the line.
/// - front_angle, rear_angle: in the direction in which the drop moves along the wall, and in the
///   opposite direction. A drop at rest has any direction.
/// - angle_error: root mean square distance of the surface from the fit over the height of the fit.
template <int D>
std::vector<MeasureSource> profile_measures(const Body<D>& body, const DropOnWall<D>& wall);

}  // namespace meniscus
