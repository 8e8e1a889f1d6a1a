// SPDX-License-Identifier: BSD-3-Clause
// Distances and forces of contact points beside a rigid partner, cluster by cluster.
#include "physics/contact/rigid/partner_field.hpp"

#include <algorithm>

namespace meniscus {
namespace {

/// Positions of a cluster in the frame of the partner.
template <int D>
LanePlace<D> place_beside(const Vec<D>& shift, const ContactPlaces<D>& places, Index cluster) {
  LanePlace<D> place;
  for (int i = 0; i < D; ++i) at(place, i) = places.x_of(cluster)[i] - shift[i];
  return place;
}

/// T and S of the four points of a cluster. T = grad S V, where S gives the energy S.V; or T = U V
/// for the pressure form. The dissertation's traction Sigma n = -beta1 grad S n is T without S.
template <int D>
void take_forces(const BodyAndPartner<D>& pair, const ContactPoints<D>& points, Index cluster,
                 const Vec<D>& shift, PartnerLayer<D>& layer) {
  const Lanes* V = layer.places.weight_of(cluster);
  const LaneField<D> field = pair.partner.shape->fields(place_beside(shift, layer.places, cluster),
                                                        points.points_in(cluster));
  for (int i = 0; i < D; ++i) {
    Lanes T = Lanes::zero();
    if (pair.form == ContactForm::pressure)
      T = field.U * V[i];
    else
      for (int j = 0; j < D; ++j) T += at(at(field.grad_S, i), j) * V[j];
    at(layer.T, cluster * D + i) = T;
    at(layer.S, cluster * D + i) = at(field.S, i);
  }
  at(layer.distances, cluster) = field.distance;
}

}  // namespace

template <int D>
void move_points(const BodyAndPartner<D>& pair, std::size_t grade, const Motion& motion,
                 PartnerLayer<D>& layer) {
  const ContactPoints<D>& points = pair.points[grade];
  points.on_patches() ? points.move(motion, layer.places)
                      : points.move(pair.moved_clusters(grade), motion, layer.places);
}

template <int D>
void take_distances(const BodyAndPartner<D>& pair, std::size_t grade, const Motion& motion,
                    PartnerLayer<D>& layer) {
  const Vec<D> shift = pair.shift(motion);
  parallel_for(
      pair.moved_clusters(grade),
      [&](Index c) {
        at(layer.distances, c) =
            pair.partner.shape->distances(place_beside(shift, layer.places, c));
      },
      16);
}

template <int D>
void move_visited(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers) {
  for (std::size_t g = 0; g < layers.size(); ++g) {
    const ContactPoints<D>& points = pair.points[g];
    PartnerLayer<D>& layer = layers[g];
    // With several grades, the coarsest points were moved already to find the grades.
    if (layers.size() == 1 || g + 1 < layers.size())
      points.move(layer.visited, motion, layer.places);
    points.update_weights(layer.visited, motion, layer.places);
  }
}

template <int D>
Gathered take_forces(const BodyAndPartner<D>& pair, std::size_t grade, const Motion& motion,
                     const Portions& shares, PartnerLayer<D>& layer) {
  constexpr std::size_t each = 2 * D + 1;
  const Vec<D> shift = pair.shift(motion);
  const bool sends = shares.are_sent();
  if (sends) layer.sent.resize(layer.visited.size() * each);
  parallel_for(
      shares.own(),
      [&](Index k) {
        const Index c = at(layer.visited, k);
        take_forces(pair, pair.points[grade], c, shift, layer);
        if (!sends) return;
        Lanes* const sent = layer.sent.data() + static_cast<std::size_t>(k) * each;
        std::copy_n(&at(layer.T, c * D), D, sent);
        std::copy_n(&at(layer.S, c * D), D, sent + D);
        sent[2 * D] = at(layer.distances, c);
      },
      16);
  return {layer.sent.data(), shares, each};
}

template <int D>
void take_sent(const Portions& shares, PartnerLayer<D>& layer) {
  if (!shares.are_sent()) return;
  constexpr std::size_t each = 2 * D + 1;
  const ItemRange own = shares.own();
  for (Index k = 0; k < static_cast<Index>(layer.visited.size()); ++k) {
    if (k >= own.begin && k < own.end) continue;
    const Index c = at(layer.visited, k);
    const Lanes* const sent = layer.sent.data() + static_cast<std::size_t>(k) * each;
    std::copy_n(sent, D, &at(layer.T, c * D));
    std::copy_n(sent + D, D, &at(layer.S, c * D));
    at(layer.distances, c) = sent[2 * D];
  }
}

template <int D>
void take_layers(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers) {
  move_visited(pair, motion, layers);
  for (std::size_t g = 0; g < layers.size(); ++g)
    take_forces(pair, g, motion,
                Division::to_each().items(static_cast<Index>(layers[g].visited.size())), layers[g]);
}

#define MENISCUS_INSTANTIATE(D)                                                           \
  template void move_points(const BodyAndPartner<D>&, std::size_t, const Motion&,         \
                            PartnerLayer<D>&);                                            \
  template void take_distances(const BodyAndPartner<D>&, std::size_t, const Motion&,      \
                               PartnerLayer<D>&);                                         \
  template void move_visited(const BodyAndPartner<D>&, const Motion&, PartnerLayers<D>&); \
  template Gathered take_forces(const BodyAndPartner<D>&, std::size_t, const Motion&,     \
                                const Portions&, PartnerLayer<D>&);                       \
  template void take_sent(const Portions&, PartnerLayer<D>&);                             \
  template void take_layers(const BodyAndPartner<D>&, const Motion&, PartnerLayers<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
