// SPDX-License-Identifier: BSD-3-Clause
// Measures of drops: how far they are from rest and from a sphere.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <vector>

namespace meniscus {

/// Area (2D: circumference) over the least one, of a ball (disk) of the same volume (area).
template <int D>
Real isoperimetric_ratio(Real area, Real volume);

/// Forces on the particles of a body that are left: sum |f_A| over the sum of the capillary forces
/// (D - 1) gamma area / R, R the radius of the ball of the same volume.
template <int D>
Real capillary_residual(std::span<const NodalVector> force, Real gamma, Real area, Real volume);

/// Of a body under the surface tension `gamma`; `viscosity` of each particle, none of a solid:
///   isoperimetric, roughness (rms of the distance of the surface from its centre, relative),
///   least_area_ratio (smallest da/dA): from 8 Gauss points per facet direction on the surface of
///   the shape functions, whatever the form of the surface tension is;
///   kinetic_at_places: of the velocities at the particles. That of the audit is of coefficients;
///   ca: capillary number mu v / gamma of a fluid, v the rms velocity at the particles about that
///   of the centre of mass.
/// What only these need is built when they are asked for first.
template <int D>
std::vector<MeasureSource> drop_measures(const Body<D>& body, std::span<const Real> viscosity,
                                         Real gamma);

}  // namespace meniscus
