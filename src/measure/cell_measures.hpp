// SPDX-License-Identifier: BSD-3-Clause
// Shape measures of red blood cells.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <vector>

namespace meniscus {

/// Shape measures of a hollow body of revolution. From its mean meridian (meridian_shape.hpp) come
/// diameter, pole_thickness, largest_thickness, its place, thickness_ratio, asymmetry, rim_spread
/// and evans_fung_rms. From its two surfaces come volumes, areas and reduced_volume. In the half
/// plane there is no rim_spread. Returns nothing for other bodies. All is built at the first
/// evaluation, when `body` must be complete.
template <int D>
std::vector<MeasureSource> cell_measures(const Body<D>& body, const UnitSystem& units);

/// "profile_rms": root mean square distance of the points (r, z) and (r, -z) from the mean
/// meridian.
template <int D>
MeasureSource profile_rms(const Body<D>& body, std::vector<Real> r, std::vector<Real> z);

}  // namespace meniscus
