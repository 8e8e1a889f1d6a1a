// SPDX-License-Identifier: BSD-3-Clause
// Walls of even thickness inside a closed surface of revolution.
#pragma once
#include "body/shapes/geometry.hpp"
#include "body/shapes/meridian.hpp"

namespace meniscus {

/// The surface of the sphere of radius 1 becomes the surface of revolution of the meridian, the
/// sphere of radius `unit_wall_inside` the parallel surface `thickness` inside it; radii become
/// normals. Angles from the axis become arc lengths in proportion.
SmoothMap<3> wall_map(Meridian meridian, Real thickness, const Vec<3>& centre);
inline constexpr Real unit_wall_inside = 0.5;

/// The wall as a body: a cubed sphere surface of cells as long as `spacing` along the meridian at
/// most, `layers` particles through the wall. Throws InputError if there is no parallel surface.
Geometry<3> make_wall(const Meridian& meridian, Real thickness, int layers, Real spacing,
                      const Vec<3>& centre);

}  // namespace meniscus
