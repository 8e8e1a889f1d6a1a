// SPDX-License-Identifier: BSD-3-Clause
// Viscosity of a solid beside its elastic stress (Kelvin-Voigt).
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

/// P = F S with S = 2 shear E' + volumetric tr(E') I, where E' = sym(F^T F') is the rate of the
/// Green strain. Rigid motions have no stress; the heat is E' : S. Integrated over the nodal cells
/// of the rule "q_scni".
template <int D>
std::unique_ptr<ForceTerm> solid_viscosity(const Body<D>& body, Real shear, Real volumetric);

}  // namespace meniscus
