// SPDX-License-Identifier: BSD-3-Clause
// The field of a rigid partner at the contact points of a body: distances and forces.
#pragma once
#include "physics/contact/rigid/partner_layers.hpp"

namespace meniscus {

/// Moves the points of a grade that this rank moves (BodyAndPartner::moved_clusters()), and
/// computes their distances.
template <int D>
void take_distances(const BodyAndPartner<D>& pair, std::size_t grade, const Motion& motion,
                    PartnerLayer<D>& layer);

/// Computes positions, weights, distances, T and S of the visited points (partner_visits.hpp), for
/// the interaction of uniform strength.
template <int D>
void take_forces(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers);

}  // namespace meniscus
