// SPDX-License-Identifier: BSD-3-Clause
// The effects of a rigid partner (wall_effects.hpp) on all contact points of a body.
#pragma once
#include "physics/contact/rigid/partner_layers.hpp"
#include "physics/contact/rigid/wall_effects.hpp"

namespace meniscus {

/// Checks before a run that W is defined wherever the body may touch the partner first. Throws
/// InputError.
template <int D>
void require_adhesion(const BodyAndPartner<D>& pair, const AdhesionPattern& W);

/// Adds varying adhesion and friction to the forces of the points within the range. Velocities have
/// to be prepared (ContactPoints::prepare_velocities()).
template <int D>
void add_effects(const BodyAndPartner<D>& pair, const WallEffects<D>& effects, const Motion& motion,
                 PartnerLayers<D>& layers, LayerTallies<WallSums>& sums);

/// Sets T to friction only, for near points at the positions of the layers, with the velocity of
/// this motion. Velocities have to be prepared.
template <int D>
void take_friction(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                   const Motion& motion, PartnerLayers<D>& layers);

/// Energy of unit adhesion, for layers without effects.
template <int D>
Real unit_energy(const BodyAndPartner<D>& pair, const WallEffects<D>& effects, const Motion& motion,
                 const PartnerLayers<D>& layers);

/// Mean velocity along the partner, relative to it, over the area with friction; zero without such
/// an area.
template <int D>
Vec<D> mean_slip(const BodyAndPartner<D>& pair, const WallEffects<D>& effects, const Motion& motion,
                 PartnerLayers<D>& layers);

}  // namespace meniscus
