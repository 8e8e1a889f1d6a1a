// SPDX-License-Identifier: BSD-3-Clause
// Measures of drops on walls: wetted area, contact angle, height.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <functional>
#include <vector>

namespace meniscus {

/// Of a front around that wetted area (2D: length): base_radius, of a disk of the area (2D: half
/// the length), and line_speed, its rate: the difference over a ten-thousandth of the radius.
template <int D>
std::vector<MeasureSource> front_measures(std::function<Real(const Motion&)> wetted_area);

/// The angle at which a sphere (2D: circle) of that volume (area) and height above a plane meets
/// it, in radians: the spherical cap.
template <int D>
Real angle_of_cap(Real volume, Real height);

/// How far a place x is above a wall at a time, and the curvature there of the surface at that
/// height: zero of a plane, 1/r at the distance r from the centre of a ball, -1/r in a cavity.
struct WallHeight {
  Real height, curvature;
};
template <int D>
using HeightAbove = std::function<WallHeight(const Vec<D>& x, Real time)>;

/// Of a drop on a wall of one curvature:
///   film: mean height of what is nearer than `contact_gap`, where the surface of contact is taken
///   to be; the least height where nothing is;
///   contact_angle: in degrees, at which the sphere (2D: circle) that fits the surface above 0.35
///   of the height of the drop best meets that surface; 180 where it does not reach it; height: of
///   the apex of that sphere over the surface of contact;
///   on a plane, contact_angle_vh: in degrees, of the cap of the same volume and height.
/// From 6 Gauss points per facet direction; built when asked for first (wetting note 2).
template <int D>
std::vector<MeasureSource> cap_measures(const Body<D>& body, HeightAbove<D> height_of,
                                        Real contact_gap, bool flat);

}  // namespace meniscus
