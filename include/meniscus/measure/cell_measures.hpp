// SPDX-License-Identifier: BSD-3-Clause
// Shape measures of red blood cells.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <vector>

namespace meniscus {

/// Shape of a hollow body of revolution from its mean meridian (meridian_shape.hpp) and from its
/// two surfaces: diameter, pole_thickness, largest_thickness and its place, thickness_ratio,
/// asymmetry, rim_spread, volumes and areas of both surfaces, reduced_volume, and
/// evans_fung_rms. None for other bodies. Nothing is built before the first of them is asked for;
/// `body` must be complete then.
std::vector<MeasureSource> cell_measures(const Body<3>& body, const UnitSystem& units);

/// "profile_rms": root mean square distance of given places (r, z), taken with z and with -z, from
/// the mean meridian.
MeasureSource profile_rms(const Body<3>& body, std::vector<Real> r, std::vector<Real> z);

}  // namespace meniscus
