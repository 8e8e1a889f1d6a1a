// SPDX-License-Identifier: BSD-3-Clause
// The field of a rigid partner at the contact points of a body: distances and forces.
#pragma once
#include "physics/contact/rigid/partner_layers.hpp"

namespace meniscus {

/// Moves the points of a grade that this process moves (BodyAndPartner::moved_clusters()). On
/// patches the motion must be known everywhere; otherwise ContactPoints::place() moves them.
template <int D>
void move_points(const BodyAndPartner<D>& pair, std::size_t grade, const Motion& motion,
                 PartnerLayer<D>& layer);
/// Computes the distances of these points, which have been moved.
template <int D>
void take_distances(const BodyAndPartner<D>& pair, std::size_t grade, const Motion& motion,
                    PartnerLayer<D>& layer);

/// Moves the visited points (partner_visits.hpp) and updates their weights. On patches the motion
/// must be known everywhere.
template <int D>
void move_visited(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers);
/// Computes distances, T and S of this share of the visited points of a grade, which have been
/// moved, for the interaction of uniform strength. The result is to be gathered before take_sent().
template <int D>
Gathered take_forces(const BodyAndPartner<D>& pair, std::size_t grade, const Motion& motion,
                     const Portions& shares, PartnerLayer<D>& layer);
template <int D>
void take_sent(const Portions& shares, PartnerLayer<D>& layer);

/// Computes all of this for the visited points, at a motion that is known everywhere.
template <int D>
void take_layers(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers);

}  // namespace meniscus
