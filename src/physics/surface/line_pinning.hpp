// SPDX-License-Identifier: BSD-3-Clause
// Contact lines that are pinned: hysteresis of the contact angle.
#pragma once
#include "body/body.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

/// Largest forces per length that hold a contact line. The line moves outward where a larger force
/// than `advancing` pulls it, and inward where a larger one than `receding` does. Below, an elastic
/// bond of this stiffness holds the line, which moves by advancing/stiffness at most.
struct LineHold {
  Real advancing, receding, stiffness;
};

/// The force of the bonds on the line of the face (sharp line note 1). The bonds begin without a
/// force at the motion `start`, or in the reference if it is null.
template <int D>
std::unique_ptr<ForceTerm> line_pinning(const Body<D>& body, const WettedFace<D>& face,
                                        const LineHold& hold, const Motion* start);

}  // namespace meniscus
