// SPDX-License-Identifier: BSD-3-Clause
// Damping of the motion of coefficients that does not move places.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

/// Velocity coefficients that cancel at the particles, (I - N) v = 0 for the fields that the shape
/// functions reproduce, carry kinetic energy but no motion of the fluid; its viscosity hardly sees
/// them. With c_A = `strength` mu_A V_A / h^2, h the mean spacing,
///   f = - (I - N)^T c s,   s = (I - N) v - w x (I - N) x,   heat = sum c_A |s_A|^2,
/// w the rotation that leaves the least heat. The force vanishes on quadratic fields and rotates
/// with the body; the sums of f and of x cross f over the coefficients are zero (static-drop note
/// 4). `viscosity`: mu of each particle.
template <int D>
std::unique_ptr<ForceTerm> coefficient_damping(const Body<D>& body, std::span<const Real> viscosity,
                                               Real strength);

}  // namespace meniscus
