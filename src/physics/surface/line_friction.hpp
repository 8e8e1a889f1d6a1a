// SPDX-License-Identifier: BSD-3-Clause
// Friction of a contact line along its wall.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

/// The force - `friction` (v . nu) nu per length of the contact line, where v is its velocity
/// relative to the wall and nu its normal along the wall. In the limit of slow motion friction v =
/// gamma (cos theta - cos theta_line).
template <int D>
std::unique_ptr<ForceTerm> line_friction(const Body<D>& body, const WettedFace<D>& face,
                                         Real friction);

}  // namespace meniscus
