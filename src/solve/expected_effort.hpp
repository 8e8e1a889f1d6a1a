// SPDX-License-Identifier: BSD-3-Clause
// What the equilibria of a scene are expected to take by Newton's method and by relaxation.
#pragma once
#include "solve/system.hpp"

#include <optional>
#include <vector>

namespace meniscus {

/// Times are of this machine, now.
struct ExpectedEffort {
  Real load_steps = 0, tangents_per_step = 0;        ///< of Newton's method
  Real seconds_per_tangent = 0, set_up_seconds = 0;  ///< the former with a preconditioner
  Real relaxation_steps = 0, seconds_per_step = 0;

  Real newton_seconds() const {
    return set_up_seconds + load_steps * tangents_per_step * seconds_per_tangent;
  }
  Real relaxation_seconds() const { return relaxation_steps * seconds_per_step; }
};

/// From the time of a force and of a tangent, what conjugate gradients took in the measurements of
/// quasi-statics note 6, and the frequency of linear elements at which the final loads make the
/// bodies swing: relaxation goes on for the time of the ramps and two periods of that, with steps
/// of `stable` times its usual share. With fluids Newton's method takes ten more steps, of implicit
/// Euler, and relaxation five times the clock of FluidRest. None where the factors of the
/// preconditioner would be too large to find out, or a term has no potential.
template <int D>
std::optional<ExpectedEffort> expected_effort(System<D>& system, const State& state,
                                              Real load_steps, Real steady_after, Real stable,
                                              const std::vector<bool>& fluid);

}  // namespace meniscus
