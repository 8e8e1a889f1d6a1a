// SPDX-License-Identifier: BSD-3-Clause
// Viscosity of a solid beside its elastic stress (Kelvin and Voigt).
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

/// P = F S, S = 2 shear E' + volumetric tr(E') I, with E' = sym(F^T F'), the rate of the Green
/// strain: no stress in rigid motions, heat E' : S. In the nodal cells of the rule "q_scni".
template <int D>
std::unique_ptr<ForceTerm> solid_viscosity(const Body<D>& body, Real shear, Real volumetric);

}  // namespace meniscus
