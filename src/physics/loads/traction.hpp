// SPDX-License-Identifier: BSD-3-Clause
// Tractions: forces per area on faces, dead, or a pressure that follows the surface.
#pragma once
#include "body/surface/face_cells.hpp"
#include "input/ramp.hpp"
#include "meniscus/physics/force_term.hpp"

#include <memory>

namespace meniscus {

/// (held-faces note 3) A dead traction: `force`, D formulas of reference place and time, per
/// reference area; on each face cell its mean. `label` in messages.
template <int D>
std::unique_ptr<ForceTerm> traction(const Body<D>& body, std::string label, FaceCells<D> cells,
                                    std::vector<Expression> force, const Ramp& ramp);

/// (held-faces note 3) A pressure against the surface, a formula of reference place and time, per
/// present area: f_A = - sum_a N_A(X_a) INT p L_a da on the quadratic patches with the nodes a
/// through places of the face. Integrals are exact for a uniform p. Its net force is then that of
/// the edge of the face, - p/2 oint x cross dx. On a face that is closed it has no net force and no
/// net moment, and the potential p V, V the enclosed volume.
template <int D>
std::unique_ptr<ForceTerm> face_pressure(const Body<D>& body, std::string label, FaceCells<D> cells,
                                         Expression pressure, const Ramp& ramp);

}  // namespace meniscus
