// SPDX-License-Identifier: BSD-3-Clause
// Explicit or implicit viscosity, by what the steps of both would be.
#pragma once
#include "solve/system.hpp"

#include <optional>
#include <string>

namespace meniscus {

struct ViscosityChoice {
  bool implicit = false;
  std::string reason;  ///< a sentence for the log
};

/// Implicit viscosity where it allows steps more than twice as long at `start`, which pays for its
/// iterations (performance note 4.1); a fixed step decides by whether it is stable without.
/// Explicit where nothing is viscous or faces are held. Throws as StableStepEstimator::estimate.
template <int D>
ViscosityChoice choose_viscosity(System<D>& system, const State& start,
                                 const std::optional<Real>& fixed_step);

}  // namespace meniscus
