// SPDX-License-Identifier: BSD-3-Clause
// Walls of even thickness inside a closed surface of revolution.
#pragma once
#include "body/shapes/geometry.hpp"
#include "body/shapes/meridian.hpp"

namespace meniscus {

/// Maps the sphere of radius 1 to the surface of revolution of the meridian, and the sphere of
/// radius `unit_wall_inside` to the parallel surface `thickness` inside. Radii are mapped to
/// normals; angles from the axis are mapped to arc lengths in proportion.
SmoothMap<3> wall_map(Meridian meridian, Real thickness, const Vec<3>& centre);
inline constexpr Real unit_wall_inside = 0.5;

/// The wall as a body. Its surface is a cubed sphere whose cells are at most `spacing` long along
/// the meridian; `layers` particles lie through the wall. Throws InputError if there is no parallel
/// surface.
Geometry<3> make_wall(const Meridian& meridian, Real thickness, int layers, Real spacing,
                      const Vec<3>& centre);

/// The section of the wall through its axis, which is along y.
Geometry<2> make_wall_section(const Meridian& meridian, Real thickness, int layers, Real spacing,
                              const Vec<2>& centre);

}  // namespace meniscus
