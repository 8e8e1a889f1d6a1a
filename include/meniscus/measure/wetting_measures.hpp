// SPDX-License-Identifier: BSD-3-Clause
// Measures of drops on walls: wetted area, contact angle, height.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <functional>
#include <vector>

namespace meniscus {

/// wetted_area: area in full contact that has the energy of the interaction, - E/W (2D: length);
/// base_radius: of a disk of that area (2D: half the length).
template <int D>
std::vector<MeasureSource> wetted_measures(std::function<Real(const Motion&)> energy,
                                           Real adhesion);

/// The angle at which a sphere (2D: circle) of that volume (area) and height above a plane meets
/// it, in radians: the spherical cap.
template <int D>
Real angle_of_cap(Real volume, Real height);

/// Of a drop on a plane, `height_of(x, time)` above it:
///   film: mean height of what is nearer than `contact_gap`, where the plane of contact is taken to
///   be; the least height where nothing is;
///   contact_angle: in degrees, at which the sphere (2D: circle) that fits the surface above 0.35
///   of the height of the drop best meets that plane; 180 where it does not reach it; height: of
///   the apex of that sphere over the plane of contact; contact_angle_vh: in degrees, of the cap of
///   the same volume and height.
/// From 6 Gauss points per facet direction; built when asked for first (wetting note 2).
template <int D>
std::vector<MeasureSource> cap_measures(const Body<D>& body,
                                        std::function<Real(const Vec<D>&, Real)> height_of,
                                        Real contact_gap);

}  // namespace meniscus
