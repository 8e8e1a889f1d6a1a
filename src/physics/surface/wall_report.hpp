// SPDX-License-Identifier: BSD-3-Clause
// What the walls of wetted faces do to a body.
#pragma once
#include "body/surface/surface_patches.hpp"
#include "meniscus/physics/force_term.hpp"

namespace meniscus {

/// The forces by which walls hold the points of `patches` against the force - factor x (gradient of
/// the quantity that was followed last). Ends a phase.
template <int D>
Report report_of_walls(SurfacePatches<D>& patches, Real factor, const Motion& motion,
                       const Forces& force) {
  ChunkTally<Resultant>& walls = patches.wall_forces(factor);
  return force.gather({walls.gathered()}, motion, [&walls](const Motion&, const Forces&) {
    Report report;
    report.outside = walls.sum(Resultant());
    return report;
  });
}

}  // namespace meniscus
