// SPDX-License-Identifier: BSD-3-Clause
// Wall supports: kernels of a hollow body reach through its wall only.
#pragma once
#include "meniscus/approx/particle_set.hpp"
#include "meniscus/body/geometry.hpp"

namespace meniscus {

/// Whether the body has an inner surface.
template <int D>
bool is_hollow(const Geometry<D>& geometry) {
  return geometry.surface->hollow();
}

/// What was done to the supports of a hollow body.
struct WallReport {
  Index shortened = 0;
  Real least_share = 1;  ///< smallest of supports left / supports asked for
};

/// Shortens the supports of a hollow body so that no kernel reaches across its cavity: a kernel
/// ends before the nearest place of the inner surface at which the wall is turned by more than 120
/// degrees. The way through a convex wall between two places with the angle a between their
/// normals is at most 1 / cos(a/2) times as long as the straight one, so what stays in reach is at
/// most twice as far inside the wall, and the other side of a cavity, turned by 180 degrees, is out
/// of reach. A support that is short everywhere needs no tests in searches and leaves shape
/// functions smooth. Does nothing to solid bodies.
template <int D>
WallReport keep_supports_in_wall(ParticleSet<D>& particles, const Geometry<D>& geometry);

}  // namespace meniscus
