// SPDX-License-Identifier: BSD-3-Clause
// Damping of combinations of velocity coefficients that leave every material point at rest.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

/// Damping of velocity coefficients whose values at the particles are zero. They carry kinetic
/// energy but no motion of the fluid, and viscosity hardly damps them. Fields that shape functions
/// reproduce have (I - N) v = 0 and are not damped. With c_A = `strength` mu_A V_A / h^2, where h
/// is the mean spacing, the damping is
///
///   f = - (I - N)^T c s,   s = (I - N) v - w x (I - N) x,   heat = sum c_A |s_A|^2.
///
/// w is the rotation with the least heat. The force vanishes on quadratic fields and rotates with
/// the body. The sums of f and of x cross f over the coefficients are zero (static-drop note 4).
/// `viscosity` has mu of each particle.
template <int D>
std::unique_ptr<ForceTerm> coefficient_damping(const Body<D>& body, std::span<const Real> viscosity,
                                               Real strength);

}  // namespace meniscus
