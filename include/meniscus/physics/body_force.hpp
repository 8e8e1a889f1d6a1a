// SPDX-License-Identifier: BSD-3-Clause
// Body force: force per mass, e.g. gravity, as a function of reference position and time.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/core/expression.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// f_A = m_A g(X_A, t) with the lumped masses.
template <int D>
std::unique_ptr<ForceTerm> body_force(const Body<D>& body, std::vector<Expression> acceleration);

}  // namespace meniscus
