// SPDX-License-Identifier: BSD-3-Clause
// What a rigid partner does to a body as a whole: energy, force, torque, gap, wetted area, slip.
#pragma once
#include "physics/contact/rigid/layer_effects.hpp"

#include <vector>

namespace meniscus {

/// All points and their forces at any motion; takes memory.
template <int D>
PartnerLayers<D> layers_at(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                           const Motion& motion);

/// Sum of S.V.
template <int D>
Real energy_of(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers);

/// Of the forces on the body. Its moment is -sum (x cross T + V cross S): turning the body turns x
/// and V.
template <int D>
Resultant resultant(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers);

/// Least distance of all points of the finest grade.
template <int D>
Real gap_at(const BodyAndPartner<D>& pair, const Motion& motion);

/// For the history: of `pair` and `effects`, which outlive them. A body that `wets` has measures of
/// wetting.
template <int D>
std::vector<MeasureSource> measures_of(const BodyAndPartner<D>& pair, const WallEffects<D>& effects,
                                       bool wets);

}  // namespace meniscus
