// SPDX-License-Identifier: BSD-3-Clause
// Estimates the effort of Newton's method and of relaxation for the equilibria of a scene.
#pragma once
#include "solve/system.hpp"

#include <optional>
#include <vector>

namespace meniscus {

/// Estimated numbers of steps, and seconds on this machine.
struct ExpectedEffort {
  Real load_steps = 0, tangents_per_step = 0;  ///< of Newton's method
  Real seconds_per_tangent = 0,
       set_up_seconds = 0;  ///< seconds_per_tangent includes the preconditioner
  Real relaxation_steps = 0, seconds_per_step = 0;

  Real newton_seconds() const {
    return set_up_seconds + load_steps * tangents_per_step * seconds_per_tangent;
  }
  Real relaxation_seconds() const { return relaxation_steps * seconds_per_step; }
};

/// Estimates the effort from three numbers: the measured time of a force and of a tangent, the
/// numbers of iterations in quasi-statics note 6, and the frequency (with linear elements) of the
/// mode that the final loads excite.
///
/// Relaxation takes the time of the ramps and two periods of this mode, with steps of the usual
/// fraction of the stable step `stable`. With fluids, Newton's method takes ten further steps of
/// implicit Euler, and relaxation five times the clock of FluidRest. Empty if the factors of the
/// preconditioner would be too large to try, or if a term has no potential.
template <int D>
std::optional<ExpectedEffort> expected_effort(System<D>& system, const State& state,
                                              Real load_steps, Real steady_after, Real stable,
                                              const std::vector<bool>& fluid);

}  // namespace meniscus
