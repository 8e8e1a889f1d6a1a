// SPDX-License-Identifier: BSD-3-Clause
// Estimates the effort of Newton's method and of relaxation for the equilibria of a scene.
#pragma once
#include "solve/step/relaxation.hpp"

#include <optional>
#include <vector>

namespace meniscus {

/// Estimated numbers of steps, and seconds on this machine.
struct ExpectedEffort {
  Real load_steps = 0, tangents_per_step = 0;  ///< of Newton's method
  bool by_factors = false;  ///< these are not tangents, but iterations with factors of the tangent
  Real seconds_per_tangent = 0,
       set_up_seconds = 0;  ///< seconds_per_tangent includes the preconditioner
  Real relaxation_steps = 0, seconds_per_step = 0;
  /// By which factor there may be more or fewer steps: how long a drop creeps nobody knows before.
  Real uncertainty = 2;

  Real newton_seconds() const {
    return set_up_seconds + load_steps * tangents_per_step * seconds_per_tangent;
  }
  Real relaxation_seconds() const { return relaxation_steps * seconds_per_step; }
};

/// Estimates both methods. Newton's method: from the time of a force and of a tangent, and the
/// number of conjugate gradients measured in quasi-statics note 6. Relaxation: by relaxing the few
/// shapes that the loads excite most, with steps `dt` and intervals of at least `fewest_steps`
/// steps. With fluids, Newton's method takes ten more steps of implicit Euler, and relaxation five
/// times the clock of FluidRest. Empty if the factors of the preconditioner would be too large to
/// try, if a term has no potential, or if relaxation is not expected to end.
template <int D>
std::optional<ExpectedEffort> expected_effort(System<D>& system, const State& state,
                                              Real load_steps, Real steady_after, Real dt,
                                              const std::vector<bool>& fluid,
                                              const typename Relaxation<D>::Tolerances&,
                                              int fewest_steps);

}  // namespace meniscus
