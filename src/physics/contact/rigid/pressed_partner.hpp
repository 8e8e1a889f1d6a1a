// SPDX-License-Identifier: BSD-3-Clause
// A rigid partner that a force or a spring presses against a body: its place, and the tangent.
#pragma once
#include "physics/contact/rigid/partner_layers.hpp"
#include "physics/contact/rigid/reach_list.hpp"

namespace meniscus {

/// The points that a pressed partner meets: work space.
template <int D>
struct PressedPoints {
  ReachList<D> list;
  PartnerLayers<D> layers;
  LayerTallies<Resultant> sums;

  explicit PressedPoints(const BodyAndPartner<D>& pair)
      : list(pair.interaction->range()),
        layers(layers_at_rest(pair)),
        sums(layer_tallies<Resultant>(pair)) {}
};

/// Moves the partner to its place at a motion that is known everywhere. Returns false if nothing
/// stops it. All processes call this.
template <int D>
bool settle_partner(const BodyAndPartner<D>& pair, const Motion& motion, PressedPoints<D>& points);

/// The change of the motion of the body relative to a partner in its place. The way s of the
/// partner changes so that R.n + k s stays constant:
///   ds = - (dR.n/du du) / (dR.n/ds + k),
/// and -ds n is added to the change of the body. The layers belong to the motion.
template <int D>
NodalVectors relative_change(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                             const Motion& motion, const Motion& change);

/// Adds the way as a further unknown: its column E_us, and dR.n/ds + k on the diagonal.
template <int D>
void add_stiffness_of_way(BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                          const Motion& motion, Index node, StiffnessMatrix& K);

}  // namespace meniscus
