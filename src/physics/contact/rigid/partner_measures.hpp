// SPDX-License-Identifier: BSD-3-Clause
// Measures of the contact of a body with a rigid partner: energy, force, torque, gap, wetted area,
// slip.
#pragma once
#include "physics/contact/rigid/layer_effects.hpp"

#include <vector>

namespace meniscus {

/// All contact points with their forces at any motion. Allocates memory.
template <int D>
PartnerLayers<D> layers_at(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                           const Motion& motion);

/// Energy of the interaction, the sum of S.V over all points.
template <int D>
Real energy_of(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers);

/// Resultant force and moment on the body. The moment is -sum (x cross T + V cross S), because a
/// rotation of the body turns x and V.
template <int D>
Resultant resultant(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers);
/// The resultant in two parts: sums of the chunks of this process, and the resultant of the
/// gathered sums.
template <int D>
void sum_resultants(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                    LayerTallies<Resultant>& sums);
Resultant resultant(const LayerTallies<Resultant>& sums);

/// Least distance between the partner and the points of the finest grade.
template <int D>
Real gap_at(const BodyAndPartner<D>& pair, const Motion& motion);

/// Measures for the history. `pair` and `effects` must outlive them. If `wets`, measures of wetting
/// are included.
template <int D>
std::vector<MeasureSource> measures_of(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                                       bool wets);

}  // namespace meniscus
