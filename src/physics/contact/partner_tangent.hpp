// SPDX-License-Identifier: BSD-3-Clause
// The tangent of contact with a rigid partner: how its forces change with the places of the points.
#pragma once
#include "partner_layers.hpp"

namespace meniscus {

/// force += the change of the forces of the partner, of uniform strength, on the points visited.
template <int D>
void add_tangent_of_partner(BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                            const Motion& motion, const Motion& change,
                            std::span<NodalVector> force);

}  // namespace meniscus
