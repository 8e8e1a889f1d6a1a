// SPDX-License-Identifier: BSD-3-Clause
// Measures of the ridge of soft ground at a contact line.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <vector>

namespace meniscus {

/// Measures of the flat face of a soft body below a drop that is round about its middle (2D:
/// symmetric).
///
/// - ridge_height: height of the highest point of the face above the face in the reference;
/// - ridge_radius: distance of this point from the middle of the drop, along the face;
/// - liquid_angle: degrees between the face inside the ridge and the free surface of the drop; 0 if
///   there are too few points;
/// - solid_angle: degrees between the faces on both sides of the ridge; 0 if there are too few
///   points.
///
/// Tangents are taken at the ridge, from profiles between 0.75 and 6 times `contact_gap`, at which
/// the traction of the contact is largest (wetting note 10). The face is normal to the axis x, y or
/// z that is nearest to the direction from the middle of the ground to the middle of the drop.
/// Surfaces have 6 Gauss points per facet direction and are built at the first evaluation.
template <int D>
std::vector<MeasureSource> ridge_measures(const Body<D>& drop, const Body<D>& ground,
                                          Real contact_gap);

}  // namespace meniscus
