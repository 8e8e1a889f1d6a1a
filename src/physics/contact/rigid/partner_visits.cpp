// SPDX-License-Identifier: BSD-3-Clause
// Chooses the clusters that interact with a rigid partner.
#include "physics/contact/rigid/partner_visits.hpp"

#include "physics/contact/pair/facet_pairs.hpp"
#include "physics/contact/rigid/partner_field.hpp"

#include <tuple>

namespace meniscus {
template <int D>
NearestPoint nearest_point(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers) {
  NearestPoint nearest;
  for (std::size_t g = 0; g < layers.size(); ++g) {
    const ItemRange moved = pair.moved_clusters(g);
    const Index end = std::min(moved.end * Lanes::width, layers[g].places.size);
    for (Index q = moved.begin * Lanes::width; q < end; ++q)
      if (const Real distance = layers[g].distance(q); distance < nearest.distance)
        nearest = {distance, g, q};
  }
  return nearest;
}

NearestPoint nearer(const NearestPoint& a, const NearestPoint& b) {
  const auto order = [](const NearestPoint& p) { return std::tuple(p.distance, p.grade, p.point); };
  return order(b) < order(a) ? b : a;
}

template <int D>
void choose_within_reach(const BodyAndPartner<D>& pair, const ReachList<D>& list,
                         PartnerLayer<D>& layer) {
  layer.visited.clear();
  const ItemRange own = pair.own_clusters(0);
  for (Index c = own.begin; c < own.end; ++c)
    if (layer.nearest_of(c) < list.distance()) layer.visited.push_back(c);
}

template <int D>
void choose_visited(const BodyAndPartner<D>& pair, const Motion& motion, ReachList<D>& list,
                    PartnerLayers<D>& layers) {
  if (!pair.interaction->ends()) return choose_grades(pair, motion, layers);
  const ContactPoints<D>& points = pair.finest();
  const Vec<D> shift = pair.shift(motion);
  if (list.holds(list.farthest(points, points.particles(), motion), shift)) return;
  move_points(pair, 0, motion, layers.front());
  take_distances(pair, 0, motion, layers.front());
  list.begin(points, motion, shift);
  choose_within_reach(pair, list, layers.front());
}

template <int D>
void choose_grades(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers) {
  if (pair.grades.count() == 1) return;
  move_points(pair, layers.size() - 1, motion, layers.back());
  take_distances(pair, layers.size() - 1, motion, layers.back());
  choose_grades(pair, layers);
}

template <int D>
void choose_grades(const BodyAndPartner<D>& pair, PartnerLayers<D>& layers) {
  const ContactPoints<D>& coarsest = pair.coarsest();
  PartnerLayer<D>& layer = layers.back();
  for (PartnerLayer<D>& each : layers) {
    each.visited.clear();
    if (&each != &layer) std::fill(each.distances.begin(), each.distances.end(), Lanes(unbounded));
  }
  // The coarsest points of a facet are one cluster.
  const ItemRange facets = pair.moved_clusters(layers.size() - 1);
  for (Index facet = facets.begin; facet < facets.end; ++facet) {
    const auto grade = static_cast<std::size_t>(
        pair.grades.grade(layer.nearest_of(facet), edge_by_points(layer.places, facet)));
    PartnerLayer<D>& chosen = layers[grade];
    const Index clusters = pair.points[grade].clusters() / coarsest.clusters();
    const ItemRange own = pair.own_clusters(grade);
    const Index end = std::min((facet + 1) * clusters, own.end);
    for (Index c = std::max(facet * clusters, own.begin); c < end; ++c) chosen.visited.push_back(c);
    if (&chosen != &layer) at(layer.distances, facet) = Lanes(unbounded);
  }
}

template <int D>
void find_near(const BodyAndPartner<D>& pair, PartnerLayers<D>& layers) {
  for (PartnerLayer<D>& layer : layers) {
    layer.near.clear();
    for (const Index c : layer.visited)
      if (layer.nearest_of(c) < pair.interaction->range()) layer.near.push_back(c);
  }
}

#define MENISCUS_INSTANTIATE(D)                                                            \
  template void choose_within_reach(const BodyAndPartner<D>&, const ReachList<D>&,         \
                                    PartnerLayer<D>&);                                     \
  template void choose_visited(const BodyAndPartner<D>&, const Motion&, ReachList<D>&,     \
                               PartnerLayers<D>&);                                         \
  template void choose_grades(const BodyAndPartner<D>&, const Motion&, PartnerLayers<D>&); \
  template void choose_grades(const BodyAndPartner<D>&, PartnerLayers<D>&);                \
  template void find_near(const BodyAndPartner<D>&, PartnerLayers<D>&);                    \
  template NearestPoint nearest_point(const BodyAndPartner<D>&, const PartnerLayers<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
