// SPDX-License-Identifier: BSD-3-Clause
// A body beside a rigid partner: its contact points in layers, one per grade, and their forces.
#pragma once
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/points/contact_resolution.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace meniscus {

/// The parts of a contact with a rigid partner that are constant during a run.
template <int D>
struct BodyAndPartner {
  MovingPartner<D> partner;
  std::shared_ptr<const Interaction> interaction;
  ContactForm form;
  FacetGrades grades;
  std::vector<ContactPoints<D>> points;  ///< contact points of the body, [grade]
  /// Who has the results at the clusters: the process that has their rows, or each process (on
  /// patches, whose forces reach the particles through nodes).
  Division division;
  SharedWork work;

  BodyAndPartner(const ContactBody<D>& body, MovingPartner<D> moving_partner,
                 std::shared_ptr<const Interaction> law, const ContactChoice& choice)
      : partner(std::move(moving_partner)),
        interaction(std::move(law)),
        form(choice.form),
        grades(choice.points, *interaction, facet_edges(body.body).least),
        points(graded_contact_points(body.body, body.beta, choice, 0, grades)),
        division(on_patches() && !body.body.division.is_whole() ? Division::to_each()
                                                                : body.body.division),
        work({body.body.division}) {}
  bool on_patches() const { return finest().on_patches(); }
  const ContactPoints<D>& finest() const { return points.front(); }
  const ContactPoints<D>& coarsest() const { return points.back(); }
  /// The clusters whose results this process has.
  ItemRange own_clusters(std::size_t grade) const {
    return division.own_rows(points[grade].clusters());
  }
  /// The clusters that this process moves. With several grades it also needs the coarsest points,
  /// one cluster per facet, of facets with own clusters of other grades, to find the grades.
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
  std::span<const Index> moved(std::size_t grade) const {
    const ItemRange range = moved_clusters(grade);
    return points[grade].all().subspan(static_cast<std::size_t>(range.begin),
                                       static_cast<std::size_t>(range.end - range.begin));
  }
  /// The clusters of a list whose field this process evaluates: a share if each has the results.
  Portions evaluated(std::span<const Index> list) const {
    return (division.is_to_each() ? evenly : Division::to_each())
        .items(static_cast<Index>(list.size()));
  }
  /// Displacement and velocity of the partner.
  Vec<D> shift(const Motion& motion) const { return partner.motion.displacement(motion.time); }
  Vec<D> velocity(const Motion& motion) const {
    return partner.motion.velocity(motion.time, partner.velocity_step);
  }
};

/// Positions of the points of a grade at a motion and their forces, [cluster][i] as in
/// contact_forms.hpp.
template <int D>
struct PartnerLayer {
  /// Clusters of this process that interact with the partner, in ascending order. Only they have
  /// forces.
  std::vector<Index> visited;
  std::vector<Index> near;  ///< visited clusters within the range
  ContactPlaces<D> places;
  AlignedVector<Lanes> T, S;
  AlignedVector<Lanes> sent;       ///< work space: results for other processes, [k of visited]
  AlignedVector<Lanes> distances;  ///< [cluster] distance from the partner; unbounded if not
                                   ///< visited

  /// A layer of a grade in which all clusters of this process are visited.
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
  /// S for the form `energy`; empty for others.
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

/// Layers by grade. The points of a facet are visited in one of the grades.
template <int D>
using PartnerLayers = std::vector<PartnerLayer<D>>;

template <int D>
PartnerLayers<D> layers_at_rest(const BodyAndPartner<D>& pair) {
  PartnerLayers<D> layers;
  for (std::size_t g = 0; g < pair.points.size(); ++g) layers.emplace_back(pair, g);
  return layers;
}

/// Results of chunks of clusters, [grade].
template <class T>
using LayerTallies = std::vector<ChunkTally<T>>;

template <class T, int D>
LayerTallies<T> layer_tallies(const BodyAndPartner<D>& pair) {
  LayerTallies<T> tallies;
  for (const ContactPoints<D>& points : pair.points)
    tallies.emplace_back(chunk_count(points.clusters()), pair.division);
  return tallies;
}

/// Sums f(grade, c) over the visited clusters of each chunk of this process.
template <int D, class T, class F>
void sum_visited(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers, const T& zero,
                 F&& f, LayerTallies<T>& sums) {
  for (std::size_t g = 0; g < layers.size(); ++g) {
    const Index clusters = pair.points[g].clusters();
    const std::vector<Index>& visited = layers[g].visited;
    parallel_for(
        pair.division.own_items(chunk_count(clusters)),
        [&](Index chunk) {
          const Index end = chunk_begin(clusters, chunk + 1);
          auto c = std::lower_bound(visited.begin(), visited.end(), chunk_begin(clusters, chunk));
          T sum = zero;
          for (; c != visited.end() && *c < end; ++c) sum = sum + f(g, *c);
          sums[g][chunk] = sum;
        },
        1);
  }
}

/// The sums over all clusters of each grade, for layers at a motion that is known everywhere. All
/// processes call this.
template <int D, class T, class F>
std::vector<T> sums_of_visited(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers,
                               const T& zero, F&& f) {
  LayerTallies<T> sums = layer_tallies<T>(pair);
  sum_visited(pair, layers, zero, f, sums);
  std::vector<T> all;
  for (ChunkTally<T>& of_grade : sums) {
    GatherTogether()({{of_grade.gathered()}});
    all.push_back(of_grade.sum(zero));
  }
  return all;
}

}  // namespace meniscus
