// SPDX-License-Identifier: BSD-3-Clause
// What the walls of wetted faces do to a body.
#pragma once
#include "body/surface/surface_patches.hpp"
#include "meniscus/physics/force_term.hpp"

namespace meniscus {

/// The forces by which walls hold the points of `patches` against the force - factor x (gradient of
/// the quantity that was followed last). Ends a phase. Walls that move change the energy of which
/// this is the force: `power_share` is one if the energy is stored, zero for a load.
template <int D>
Report report_of_walls(SurfacePatches<D>& patches, Real factor, const Motion& motion,
                       const Forces& force, Real power_share = 1) {
  auto& walls = patches.wall_forces(factor);
  return force.gather({walls.gathered()}, motion,
                      [&walls, power_share](const Motion&, const Forces&) {
                        const auto all = walls.sum({});
                        Report report;
                        report.outside = all.total;
                        report.external_power = power_share * all.power;
                        return report;
                      });
}

}  // namespace meniscus
