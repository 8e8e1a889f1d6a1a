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
  /// Each rank moves and visits the clusters whose forces it adds up; all of them where few ranks
  /// have the body, and on patches, whose forces come to the particles by way of the nodes.
  Division division;

  BodyAndPartner(const ContactBody<D>& body, MovingPartner<D> moving_partner,
                 std::shared_ptr<const Interaction> law, const ContactChoice& choice)
      : partner(std::move(moving_partner)),
        interaction(std::move(law)),
        form(choice.form),
        grades(choice.points, *interaction, facet_edges(body.body).least),
        points(graded_contact_points(body.body, body.beta, choice, 0, grades)),
        ranks({body.body.division}),
        division(ranks.are_few() || finest().on_patches() ? Division::to_each()
                                                          : body.body.division) {}

  const ContactPoints<D>& finest() const { return points.front(); }
  const ContactPoints<D>& coarsest() const { return points.back(); }
  /// Whose forces this rank adds up.
  ItemRange own_clusters(std::size_t grade) const {
    return division.own_rows(points[grade].clusters());
  }
  /// That this rank moves: of several grades the coarsest, a cluster for each facet, are needed to
  /// know the grades of own clusters.
  ItemRange moved_clusters(std::size_t grade) const {
    ItemRange moved = own_clusters(grade);
    if (grade + 1 < points.size()) return moved;
    for (std::size_t g = 0; g < grade; ++g) {
      const ItemRange own = own_clusters(g);
      const Index each = points[g].clusters() / coarsest().clusters();
      if (own.begin == own.end) continue;
      moved.begin = std::min(moved.begin, own.begin / each);
      moved.end = std::max(moved.end, (own.end - 1) / each + 1);
    }
    return moved;
  }
  /// By which ranks divide what is for the same clusters of all of them.
  Division parts() const { return division.is_to_each() ? ranks.division() : Division::to_each(); }
  /// Whether no rank has any of what this rank has none of.
  bool without(const std::vector<Index>& clusters) const {
    return clusters.empty() && (division.is_to_each() || meniscus::ranks().alone());
  }
  /// Of what ranks have found that each looked at a part.
  Real largest(Real mine) const {
    if (ranks.division().is_to_each() || meniscus::ranks().alone()) return mine;
    const std::vector<Real> all = said_by_ranks(mine);
    return *std::max_element(all.begin(), all.end());
  }
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
  /// Clusters of this rank that feel the partner, in ascending order: only they have forces.
  std::vector<Index> visited;
  std::vector<Index> near;  ///< of these, clusters within the range
  ContactPlaces<D> places;
  AlignedVector<Lanes> T, S;
  AlignedVector<Lanes> distances;  ///< [cluster] from the surface of the partner; others: beyond

  /// Of a grade; all of this rank are visited.
  PartnerLayer(const BodyAndPartner<D>& pair, std::size_t grade)
      : places(pair.points[grade].at_rest()) {
    const auto clusters = static_cast<std::size_t>(pair.points[grade].clusters());
    const ItemRange own = pair.own_clusters(grade);
    visited.resize(static_cast<std::size_t>(own.end - own.begin));
    std::iota(visited.begin(), visited.end(), own.begin);
    near.reserve(visited.size());
    T.assign(clusters * D, Lanes::zero());
    S = T;
    distances.assign(clusters, Lanes(unbounded));
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
  PartnerLayers<D> layers;
  for (std::size_t g = 0; g < pair.points.size(); ++g) layers.emplace_back(pair, g);
  return layers;
}

/// Sum of f(c) over the clusters of a grade that all ranks visit, added in the order of the chunks
/// of all clusters.
template <int D, class T, class F>
T sum_of_visited(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers, std::size_t grade,
                 const T& zero, F&& f) {
  const Index clusters = pair.points[grade].clusters();
  const std::vector<Index>& visited = layers[grade].visited;
  PerChunk<T> sums(chunk_count(clusters), zero);
  parallel_for(
      pair.division.own_items(chunk_count(clusters)),
      [&](Index chunk) {
        const Index end = chunk_begin(clusters, chunk + 1);
        auto c = std::lower_bound(visited.begin(), visited.end(), chunk_begin(clusters, chunk));
        T sum = zero;
        for (; c != visited.end() && *c < end; ++c) sum += f(*c);
        at(sums, chunk) = sum;
      },
      1);
  pair.division.complete_items(chunk_count(clusters), sums.begin(), sizeof(T));
  return std::accumulate(sums.begin(), sums.end(), zero);
}

}  // namespace meniscus
