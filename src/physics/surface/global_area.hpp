// SPDX-License-Identifier: BSD-3-Clause
// Resistance of a whole surface against a change of its total area, as of a lipid membrane whose
// molecules flow to where there is room (membranes note 5).
#pragma once
#include "body/body.hpp"
#include "input/ramp.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

struct GlobalAreaKeys {
  Real modulus = 0;  ///< tension per relative deviation of the area
  Real target = 1;   ///< area relative to the reference
  Ramp ramp;         ///< from target 1
};

/// The energy K A0/2 (A/A0 - target)^2 of the area A of the whole surface, A0 in the reference, and
/// its exact gradient: a tension K (A/A0 - target) that is the same everywhere. `points`: Gauss
/// points per direction and facet.
template <int D>
std::unique_ptr<ForceTerm> global_area(const Body<D>& body, const GlobalAreaKeys& keys, int points);

}  // namespace meniscus
