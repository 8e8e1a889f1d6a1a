// SPDX-License-Identifier: BSD-3-Clause
// A body beside a rigid partner: its contact points in layers, one for each grade, and what the
// partner does to them.
#pragma once
#include "meniscus/physics/contact.hpp"
#include "meniscus/physics/contact_resolution.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "contact_ranks.hpp"

namespace meniscus {

/// What stays the same as they move.
template <int D>
struct BodyAndPartner {
  MovingPartner<D> partner;
  std::shared_ptr<const Interaction> interaction;
  ContactForm form;
  FacetGrades grades;
  std::vector<ContactPoints<D>> points;  ///< of the body, by grade
  ContactRanks ranks;

  BodyAndPartner(const ContactBody<D>& body, MovingPartner<D> moving_partner,
                 std::shared_ptr<const Interaction> law, const ContactChoice& choice)
      : partner(std::move(moving_partner)),
        interaction(std::move(law)),
        form(choice.form),
        grades(choice.points, *interaction, facet_edges(body.body).least),
        points(graded_contact_points(body.body, body.beta, choice, 0, grades)),
        ranks({body.body.division}) {}

  const ContactPoints<D>& finest() const { return points.front(); }
  const ContactPoints<D>& coarsest() const { return points.back(); }
  /// Of the partner: from where it was made, and how fast.
  Vec<D> shift(const Motion& motion) const { return partner.motion.displacement(motion.time); }
  Vec<D> velocity(const Motion& motion) const {
    return partner.motion.velocity(motion.time, partner.velocity_step);
  }
};

/// Places of the points of a grade at a motion and their forces, [cluster][i] as in
/// contact_forms.hpp.
template <int D>
struct PartnerLayer {
  std::vector<Index> visited;  ///< clusters that feel the partner: only they have forces
  std::vector<Index> near;     ///< of these, clusters within the range
  ContactPlaces<D> places;
  AlignedVector<Lanes> T, S;
  AlignedVector<Lanes> distances;  ///< [cluster] from the surface of the partner; others: beyond

  /// All are visited.
  explicit PartnerLayer(const ContactPoints<D>& points) : places(points.at_rest()) {
    visited.resize(static_cast<std::size_t>(points.clusters()));
    std::iota(visited.begin(), visited.end(), Index{0});
    near.reserve(visited.size());
    T.assign(visited.size() * D, Lanes::zero());
    S = T;
    distances.assign(visited.size(), Lanes(unbounded));
  }
  /// S, which the form `energy` alone has.
  std::span<const Lanes> moment(ContactForm form) const {
    return form == ContactForm::energy ? std::span<const Lanes>(S) : std::span<const Lanes>();
  }
  Real distance(Index q) const { return at(distances, q / Lanes::width)[q % Lanes::width]; }
  Real nearest_of(Index cluster) const {
    const Lanes& d = at(distances, cluster);
    return std::min(std::min(d[0], d[1]), std::min(d[2], d[3]));
  }
  std::size_t bytes() const { return places.bytes() + (T.size() + S.size()) * sizeof(Lanes); }
};

/// By grade. The points of a facet are visited in one of them.
template <int D>
using PartnerLayers = std::vector<PartnerLayer<D>>;

template <int D>
PartnerLayers<D> layers_at_rest(const BodyAndPartner<D>& pair) {
  return PartnerLayers<D>(pair.points.begin(), pair.points.end());
}

}  // namespace meniscus
