// SPDX-License-Identifier: BSD-3-Clause
// Tractions: forces per area on faces. A dead traction keeps its direction; a pressure follows the
// surface.
#pragma once
#include "body/surface/face_cells.hpp"
#include "input/ramp.hpp"
#include "meniscus/physics/force_term.hpp"

#include <map>
#include <memory>
#include <vector>

namespace meniscus {

/// A dead traction (held-faces note 3). `force` has D formulas of reference position and time;
/// `factor` times their values is the force per reference area, of which each face cell uses the
/// mean. `label` is the name in messages.
template <int D>
std::unique_ptr<ForceTerm> traction(const Body<D>& body, std::string label, FaceCells<D> cells,
                                    std::vector<Expression> force, const Ramp& ramp,
                                    Real factor = 1);

/// A pressure on the current surface (held-faces note 3). `pressure` is a formula of reference
/// position and time, per current area. The forces are f_A = - sum_a N_A(X_a) INT p L_a da on
/// quadratic patches, whose nodes a are current positions of points of the face. Integrals are
/// exact for a uniform p. The net force then depends on the edge of the face only: - p/2 oint x
/// cross dx. On a closed face the net force and the net moment vanish, and the potential is p V
/// with the enclosed volume V.
///
/// On an open face an even pressure has a potential, too, where the edge of the face lies on planes
/// normal to an axis and is held there: `held` has the directions in which the face cells of the
/// particles of the body do not move.
using HeldDirections = std::map<Index, std::vector<Eigen::Vector3d>>;
template <int D>
std::unique_ptr<ForceTerm> face_pressure(const Body<D>& body, std::string label, FaceCells<D> cells,
                                         Expression pressure, const Ramp& ramp,
                                         const HeldDirections& held = {});

}  // namespace meniscus
