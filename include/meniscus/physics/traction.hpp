// SPDX-License-Identifier: BSD-3-Clause
// Tractions: forces per area on faces, dead, or a pressure that follows the surface.
#pragma once
#include "meniscus/body/face_cells.hpp"
#include "meniscus/core/ramp.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

/// (held-faces note 3) `force` per reference area: D formulas of reference place and time; or, if
/// that is empty, a `pressure` per present area against the surface, a formula.
struct TractionLoad {
  std::vector<Expression> force;
  Expression pressure;
  Ramp ramp;
};

/// On each face cell the mean of the dead traction, or - p cof(F) N with the means of p and F over
/// the face cell and N point by point. `label` in messages. The face cells have gradients for a
/// pressure.
template <int D>
std::unique_ptr<ForceTerm> traction(const Body<D>& body, std::string label, FaceCells<D> cells,
                                    const TractionLoad& load);

}  // namespace meniscus
