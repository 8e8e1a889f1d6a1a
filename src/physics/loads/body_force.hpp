// SPDX-License-Identifier: BSD-3-Clause
// Body force: force per mass, e.g. gravity, as a function of reference position and time.
#pragma once
#include "body/body.hpp"
#include "input/expression.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// f_A = m_A g(X_A, t). In motion the masses are Body::mass, those of the time step: weight and
/// inertia then cancel, and a body falls without strain. At rest there is no inertia to cancel, and
/// Body::mass_integral, INT rho N_A dV, does the work of the weight exactly. `mass` [particle] must
/// outlive the term.
template <int D>
std::unique_ptr<ForceTerm> body_force(const Body<D>& body, const std::vector<Real>& mass,
                                      std::vector<Expression> acceleration);

/// Of a drop whose pressure and tension act on patches (`balanced`): the gradient of M g(t) . x_c,
/// M the mass and x_c the centroid of the volume that the patches enclose, for g that does not
/// depend on the place and a uniform density. Pressure, tension and weight then act on one surface,
/// and a drop at rest is as exact as that.
template <int D>
std::unique_ptr<ForceTerm> weight_on_patches(const Body<D>& body,
                                             std::vector<Expression> acceleration);

}  // namespace meniscus
