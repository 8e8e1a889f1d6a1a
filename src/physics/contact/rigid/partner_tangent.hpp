// SPDX-License-Identifier: BSD-3-Clause
// The tangent of contact with a rigid partner.
#pragma once
#include "physics/contact/rigid/partner_layers.hpp"

namespace meniscus {

/// force += the change of the forces of the partner on visited points, for uniform strength.
template <int D>
void add_tangent_of_partner(BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                            const Motion& motion, const Motion& change, const Forces& force);

/// The change of the resultant force on the body. All processes call this, at a motion that is
/// known everywhere.
template <int D>
Vec<D> change_of_resultant(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                           const Motion& motion, const Motion& change);

/// Adds minus the tangent as elements, for points by shape functions and the form `energy`. The
/// layers belong to this motion.
template <int D>
void add_stiffness_of_partner(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                              const Motion& motion, StiffnessMatrix& K);

}  // namespace meniscus
