// SPDX-License-Identifier: BSD-3-Clause
// Supports of hollow bodies: kernels reach through the wall only, not across the cavity.
#pragma once
#include "body/shapes/geometry.hpp"
#include "kernel/particle_set.hpp"

namespace meniscus {

/// True if the body has an inner surface.
template <int D>
bool is_hollow(const Geometry<D>& geometry) {
  return geometry.surface->hollow();
}

/// Result of keep_supports_in_wall().
struct WallReport {
  Index shortened = 0;
  Real least_share = 1;  ///< smallest ratio of support to original support
};

/// Shortens the supports of a hollow body so that no kernel reaches across its cavity. A kernel
/// ends before the nearest point of the inner surface at which the wall is turned by more than 120
/// degrees. In a convex wall, the path inside the wall between two places is at most 1 / cos(a/2)
/// times the straight distance, with a the angle between their normals. So points in reach are at
/// most twice as far along the wall, and the other side of the cavity, turned by 180 degrees, is
/// out of reach. Searches need no further tests, and shape functions stay smooth. Does nothing to
/// solid bodies. Throws InputError if a hollow body has no Geometry::director.
template <int D>
WallReport keep_supports_in_wall(ParticleSet<D>& particles, const Geometry<D>& geometry);

}  // namespace meniscus
