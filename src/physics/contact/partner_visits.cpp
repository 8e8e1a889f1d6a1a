// SPDX-License-Identifier: BSD-3-Clause
// Choosing the clusters that feel a rigid partner.
#include "partner_visits.hpp"

#include "facet_pairs.hpp"
#include "partner_field.hpp"

namespace meniscus {
namespace {

/// Clusters are kept in the list for as long as no other point can have come within the range.
template <int D>
void choose_within_reach(const BodyAndPartner<D>& pair, const Motion& motion, ReachList<D>& list,
                         PartnerLayer<D>& layer) {
  const ContactPoints<D>& points = pair.finest();
  const Vec<D> shift = pair.shift(motion);
  if (list.holds(points, motion, shift)) return;
  if (points.in_halo()) throw HaloOutgrown();
  take_distances(pair, points, motion, layer);
  list.begin(points, motion, shift);
  layer.visited.clear();
  for (Index c = 0; c < points.clusters(); ++c)
    if (layer.nearest_of(c) < list.distance()) layer.visited.push_back(c);
}

}  // namespace

template <int D>
void choose_visited(const BodyAndPartner<D>& pair, const Motion& motion, ReachList<D>& list,
                    PartnerLayers<D>& layers) {
  if (pair.interaction->ends())
    choose_within_reach(pair, motion, list, layers.front());
  else
    choose_grades(pair, motion, layers);
}

template <int D>
void choose_grades(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers) {
  if (pair.grades.count() == 1) return;
  const ContactPoints<D>& coarsest = pair.coarsest();
  PartnerLayer<D>& layer = layers.back();
  take_distances(pair, coarsest, motion, layer);
  for (PartnerLayer<D>& each : layers) {
    each.visited.clear();
    if (&each != &layer) std::fill(each.distances.begin(), each.distances.end(), Lanes(unbounded));
  }
  // The coarsest points of a facet are a cluster.
  for (Index facet = 0; facet < coarsest.clusters(); ++facet) {
    const int grade =
        pair.grades.grade(layer.nearest_of(facet), edge_by_points(layer.places, facet));
    PartnerLayer<D>& chosen = at(layers, grade);
    const Index clusters = at(pair.points, grade).clusters() / coarsest.clusters();
    for (Index c = facet * clusters; c < (facet + 1) * clusters; ++c) chosen.visited.push_back(c);
    if (&chosen != &layer) at(layer.distances, facet) = Lanes(unbounded);
  }
}

template <int D>
void find_near(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers) {
  bool any_near = false;
  for (PartnerLayer<D>& layer : layers) {
    layer.near.clear();
    for (const Index c : layer.visited)
      if (layer.nearest_of(c) < pair.interaction->range()) layer.near.push_back(c);
    any_near = any_near || !layer.near.empty();
  }
  // Distances of points beyond reach are those of when the list was made.
  if (any_near || !pair.interaction->ends()) return;
  if (!pair.finest().follows_all()) throw HaloOutgrown();
  take_distances(pair, pair.finest(), motion, layers.front());
}

template <int D>
NearestPoint nearest_point(const PartnerLayers<D>& layers) {
  NearestPoint nearest;
  for (std::size_t g = 0; g < layers.size(); ++g)
    for (Index q = 0; q < layers[g].places.size; ++q)
      if (const Real distance = layers[g].distance(q); distance < nearest.distance)
        nearest = {distance, g, q};
  return nearest;
}

#define MENISCUS_INSTANTIATE(D)                                                            \
  template void choose_visited(const BodyAndPartner<D>&, const Motion&, ReachList<D>&,     \
                               PartnerLayers<D>&);                                         \
  template void choose_grades(const BodyAndPartner<D>&, const Motion&, PartnerLayers<D>&); \
  template void find_near(const BodyAndPartner<D>&, const Motion&, PartnerLayers<D>&);     \
  template NearestPoint nearest_point(const PartnerLayers<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
