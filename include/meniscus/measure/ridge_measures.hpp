// SPDX-License-Identifier: BSD-3-Clause
// Measures of the ridge that a contact line pulls up from soft ground.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <vector>

namespace meniscus {

/// Of a drop that lies on the flat face of a soft body, round about its middle (2D: symmetric):
///   ridge_height: of the highest place of that face over where the face is in the reference;
///   ridge_radius: distance of that place from the middle of the drop, along the face;
///   liquid_angle, solid_angle: in degrees, between the tangents of the face within the ridge and
///   of the free surface of the drop, and between those of the face on both sides; 0 where there
///   are not enough points. Tangents are taken at the ridge, from profiles between 0.75 and 6 times
///   `contact_gap`, where the traction of the contact is largest (wetting note 10).
/// The face is across the axis x, y or z that is nearest to the way from the middle of the ground
/// to that of the drop. From 6 Gauss points per facet direction; built when asked for first.
template <int D>
std::vector<MeasureSource> ridge_measures(const Body<D>& drop, const Body<D>& ground,
                                          Real contact_gap);

}  // namespace meniscus
