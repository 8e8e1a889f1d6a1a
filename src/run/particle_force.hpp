// SPDX-License-Identifier: BSD-3-Clause
// A force on the particles of a body that the caller of the library computes.
#pragma once
#include "meniscus/run.hpp"
#include "meniscus/scene/load.hpp"

#include <memory>
#include <string>

namespace meniscus {

/// The load that applies the force F_A of `function` at each particle A of a body. F_A acts at the
/// position x(X_A), so that coefficient B gets sum_A N_B(X_A) F_A. The work of the force is booked
/// as external work. For runs on one process. A SolveError of `function`, and a force that is not
/// finite, fail the step; other exceptions of `function` are passed on.
template <int D>
std::unique_ptr<const Load<D>> particle_force(const std::string& body, ForceFunction function);

}  // namespace meniscus
