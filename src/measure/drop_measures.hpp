// SPDX-License-Identifier: BSD-3-Clause
// Measures of drops: deviation from rest and from a sphere.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <vector>

namespace meniscus {

/// Ratio of `area` (2D: circumference) to the area of a ball (disk) with the same volume (area).
Real isoperimetric_ratio(Real area, Real volume, int space_dimension);

/// The unbalanced forces on the particles of a body: sum |f_A| relative to the capillary forces (d
/// - 1) gamma area / R in d dimensions, where R is the radius of the ball of the same volume.
Real capillary_residual(std::span<const NodalVector> force, Real gamma, Real area, Real volume,
                        int space_dimension);

/// Measures of a body with surface tension `gamma`. `viscosity` has one value per particle and is
/// empty for a solid.
///
/// - isoperimetric: see isoperimetric_ratio().
///
/// - roughness: relative rms deviation of the distance of the surface from its centre.
///
/// - least_area_ratio: smallest da/dA.
///
/// - kinetic_at_places: kinetic energy from velocities at the particles. (The audit uses
/// coefficients.)
///
/// - ca: capillary number mu v / gamma of a fluid, where v is the rms velocity at the particles
/// relative to their mean velocity.
///
/// For every form of surface tension, the first three measures use 8 Gauss points per facet
/// direction on the surface that the shape functions give. This surface is built at the first
/// evaluation.
template <int D>
std::vector<MeasureSource> drop_measures(const Body<D>& body, std::span<const Real> viscosity,
                                         Real gamma);

}  // namespace meniscus
