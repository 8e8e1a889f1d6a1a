// SPDX-License-Identifier: BSD-3-Clause
// Chooses explicit or implicit viscosity by comparing their steps.
#pragma once
#include "solve/system.hpp"

#include <optional>
#include <string>

namespace meniscus {

struct ViscosityChoice {
  bool implicit = false;
  std::string reason;  ///< a sentence for the log
};

/// Chooses implicit viscosity if it allows steps more than twice as long at `start`, which pays for
/// its iterations (performance note 4.1). For a fixed step, chooses implicit viscosity if the step
/// is unstable otherwise. Chooses explicit viscosity if nothing is viscous. Throws like
/// StableStepEstimator::estimate.
template <int D>
ViscosityChoice choose_viscosity(System<D>& system, const State& start,
                                 const std::optional<Real>& fixed_step);

}  // namespace meniscus
