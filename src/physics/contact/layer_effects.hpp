// SPDX-License-Identifier: BSD-3-Clause
// The effects of a rigid partner (wall_effects.hpp) on all contact points of a body beside it.
#pragma once
#include "partner_layers.hpp"
#include "wall_effects.hpp"

namespace meniscus {

/// Before a run, that W can be taken wherever on the partner the body may touch it first; throws
/// InputError.
template <int D>
void require_adhesion(const BodyAndPartner<D>& pair, const AdhesionPattern& W);

/// Adds adhesion that varies, and friction, to the forces of the points within the range.
template <int D>
WallSums add_effects(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                     const Motion& motion, PartnerLayers<D>& layers);

/// T of friction alone, at the places of the layers, by the velocity of this motion: of the points
/// that are near.
template <int D>
void take_friction(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                   const Motion& motion, PartnerLayers<D>& layers);

/// Energy of unit adhesion, of layers without effects.
template <int D>
Real unit_energy(const BodyAndPartner<D>& pair, const WallEffects<D>& effects, const Motion& motion,
                 const PartnerLayers<D>& layers);

/// Of the velocity along the partner and relative to it, over the area that rubs; zero without any.
template <int D>
Vec<D> mean_slip(const BodyAndPartner<D>& pair, const WallEffects<D>& effects, const Motion& motion,
                 PartnerLayers<D>& layers);

}  // namespace meniscus
