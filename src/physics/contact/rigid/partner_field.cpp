// SPDX-License-Identifier: BSD-3-Clause
// Distances and forces of contact points beside a rigid partner, cluster by cluster.
#include "physics/contact/rigid/partner_field.hpp"

#include "parallel/divided.hpp"

namespace meniscus {
namespace {

/// Results of a cluster, as sent to other ranks.
template <int D>
struct AtCluster {
  Lanes T[D], S[D], distances;

  AtCluster() = default;
  AtCluster(const PartnerLayer<D>& layer, Index c) : distances(at(layer.distances, c)) {
    for (int i = 0; i < D; ++i) {
      T[i] = at(layer.T, c * D + i);
      S[i] = at(layer.S, c * D + i);
    }
  }
  void put(Index c, PartnerLayer<D>& layer) const {
    for (int i = 0; i < D; ++i) {
      at(layer.T, c * D + i) = T[i];
      at(layer.S, c * D + i) = S[i];
    }
    at(layer.distances, c) = distances;
  }
};

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
void take_distances(const BodyAndPartner<D>& pair, std::size_t grade, const Motion& motion,
                    PartnerLayer<D>& layer) {
  const ContactPoints<D>& points = pair.points[grade];
  const Vec<D> shift = pair.shift(motion);
  const auto take = [&](Index c) {
    at(layer.distances, c) = pair.partner.shape->distances(place_beside(shift, layer.places, c));
  };
  if (const Division parts = pair.parts(); pair.division.is_to_each()) {
    points.move(motion, layer.places, parts);
    parallel_for(parts.own_items(points.clusters()), take, 16);
    parts.complete_items(points.clusters(), layer.distances.data(), sizeof(Lanes));
  } else {
    points.move(pair.moved_clusters(grade), motion, layer.places);
    parallel_for(pair.moved_clusters(grade), take, 16);
  }
}

template <int D>
void take_forces(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers) {
  const Vec<D> shift = pair.shift(motion);
  const Division parts = pair.parts();
  for (std::size_t g = 0; g < layers.size(); ++g) {
    const ContactPoints<D>& points = pair.points[g];
    PartnerLayer<D>& layer = layers[g];
    // With several grades, the coarsest points were moved already to find the grades.
    if (layers.size() == 1 || g + 1 < layers.size())
      points.move(layer.visited, motion, layer.places, parts);
    points.update_weights(layer.visited, motion, layer.places, parts);
    divided_for(
        parts, static_cast<Index>(layer.visited.size()),
        [&](Index k) { take_forces(pair, points, at(layer.visited, k), shift, layer); },
        [&](Index k) { return AtCluster<D>(layer, at(layer.visited, k)); },
        [&](Index k, const AtCluster<D>& of_other) { of_other.put(at(layer.visited, k), layer); },
        16);
  }
}

#define MENISCUS_INSTANTIATE(D)                                                      \
  template void take_distances(const BodyAndPartner<D>&, std::size_t, const Motion&, \
                               PartnerLayer<D>&);                                    \
  template void take_forces(const BodyAndPartner<D>&, const Motion&, PartnerLayers<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
