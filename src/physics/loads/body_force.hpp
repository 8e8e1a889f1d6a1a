// SPDX-License-Identifier: BSD-3-Clause
// Body force: force per mass, e.g. gravity, as a function of reference position and time.
#pragma once
#include "body/body.hpp"
#include "input/expression.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// f_A = m_A g(X_A, t). `mass` [particle] is one of two masses and must outlive the term. Dynamics
/// uses Body::mass, the masses of the time step: weight and inertia then cancel, and a body falls
/// without strain. Equilibria use Body::mass_integral, INT rho N_A dV: this weight does the exact
/// work, and there is no inertia.
template <int D>
std::unique_ptr<ForceTerm> body_force(const Body<D>& body, const std::vector<Real>& mass,
                                      std::vector<Expression> acceleration);

/// The weight of a drop whose pressure and surface tension act on patches (form `balanced`). The
/// force is the gradient of M g(t) . x_c, where M is the mass and x_c the centroid of the volume
/// that the patches enclose. g does not depend on position, and the density is uniform. Pressure,
/// tension and weight then act on the same surface, so that a drop at rest is in equilibrium to the
/// accuracy of the patches.
template <int D>
std::unique_ptr<ForceTerm> weight_on_patches(const Body<D>& body,
                                             std::vector<Expression> acceleration);

}  // namespace meniscus
