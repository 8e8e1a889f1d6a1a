// SPDX-License-Identifier: BSD-3-Clause
// Stress of branches of Maxwell beside the elastic stress of a body.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"
#include "physics/internal/maxwell_branches.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// The force of the branches (viscoelasticity note), integrated over the nodal cells of the rule
/// "q_scni". At most MaxwellPoints::most_branches. They store energy,
/// and their loss is heat.
template <int D>
std::unique_ptr<ForceTerm> viscoelasticity(const Body<D>& body,
                                           std::vector<MaxwellBranch> branches);

}  // namespace meniscus
