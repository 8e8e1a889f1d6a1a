// SPDX-License-Identifier: BSD-3-Clause
// Updates the contact points of two bodies that may be within reach of each other.
#include "physics/contact/pair/pair_visits.hpp"

#include "physics/contact/points/contact_resolution.hpp"

#include <algorithm>

namespace meniscus {
namespace {

template <int D>
FacetGrades grades_of(const ContactBody<D>& first, const ContactBody<D>& second,
                      const Interaction& interaction, const ContactChoice& choice) {
  const Real edge = std::min(facet_edges(first.body).least, facet_edges(second.body).least);
  // Points of volumes have no facets.
  return FacetGrades::of_pairs(choice.form == ContactForm::volume ? 1 : choice.points, interaction,
                               edge);
}

template <int D>
GradedPoints<D> points_of(const ContactBody<D>& b, const ContactChoice& choice, std::size_t side,
                          const FacetGrades& grades) {
  GradedPoints<D> all;
  if (choice.form == ContactForm::volume) {
    all.push_back(ContactPoints<D>::in_volume(b.body, b.beta, choice.points));
    return all;
  }
  return graded_contact_points(b.body, b.beta, choice, side, grades);
}

/// Upper bound for how much nearer points of two facets can be than their coarsest points. Zero if
/// facets have one grade.
template <int D>
Real overhang(const ContactBody<D>& first, const ContactBody<D>& second,
              const FacetGrades& grades) {
  if (grades.count() == 1) return 0;
  return FacetPairs<D>::overhang(
      std::max(facet_edges(first.body).largest, facet_edges(second.body).largest));
}

template <int D>
std::vector<ContactPlaces<D>> places_at_rest(const GradedPoints<D>& points) {
  std::vector<ContactPlaces<D>> all;
  for (const ContactPoints<D>& grade : points) all.push_back(grade.at_rest());
  return all;
}

template <int D>
std::vector<Index> clusters_per_facet(const GradedPoints<D>& points) {
  std::vector<Index> all;
  for (const ContactPoints<D>& grade : points)
    all.push_back(grade.clusters() / points.back().clusters());
  return all;
}

template <int D>
Offset pairs_of(const FacetRows<D>& rows) {
  const Offset clusters = rows.clusters_per_facet * rows.clusters_per_facet;
  return static_cast<Offset>(rows.facets->partner.size()) * clusters * Lanes::width * Lanes::width;
}

}  // namespace

template <int D>
std::size_t VisitedPair<D>::bytes() const {
  std::size_t n = facets.bytes();
  for (const auto* side : {&first, &second})
    for (const ContactPlaces<D>& places : *side) n += places.bytes();
  return n;
}

template <int D>
PairVisits<D>::PairVisits(const ContactBody<D>& first, const ContactBody<D>& second,
                          const Interaction& interaction, const ContactLaw& law,
                          const ContactChoice& choice)
    : reach_(law.reach()),
      grades_(grades_of(first, second, interaction, choice)),
      first_(points_of(first, choice, 0, grades_)),
      second_(points_of(second, choice, 1, grades_)),
      ranks_({first.body.division, second.body.division}),
      list_(reach_ + overhang(first, second, grades_), choice.skin * law.sigma0),
      now_(at_rest()) {}

template <int D>
VisitedPair<D> PairVisits<D>::at_rest() const {
  return {places_at_rest(first_), places_at_rest(second_),
          FacetPairs<D>(grades_, clusters_per_facet(first_), reach_), &list_};
}

/// True if the list has all pairs within reach at this motion.
template <int D>
bool PairVisits<D>::holds(const Motion& motion) const {
  return first_since_.farthest(first_.back(), motion) +
             second_since_.farthest(second_.back(), motion) <=
         list_.skin() * (1 - 1e-12);
}

template <int D>
void PairVisits<D>::visit(const Motion& motion) {
  if (holds(motion)) {
    move_listed(motion, now_);
  } else if (first_.back().in_halo()) {
    throw HaloOutgrown();
  } else {
    make_list(motion, list_, now_);
    first_since_.begin(first_.back(), motion);
    second_since_.begin(second_.back(), motion);
  }
  bring_others(motion, now_);
}

/// Moves the coarsest points that are in the list.
template <int D>
void PairVisits<D>::move_listed(const Motion& motion, VisitedPair<D>& at_motion) const {
  first_.back().move(list_.of_first().active, motion, at_motion.first.back(), ranks_.division());
  second_.back().move(list_.of_second().active, motion, at_motion.second.back(), ranks_.division());
}

/// Moves all coarsest points and builds a list of them.
template <int D>
void PairVisits<D>::make_list(const Motion& motion, ContactList<D>& list,
                              VisitedPair<D>& at_motion) const {
  first_.back().move(motion, at_motion.first.back(), ranks_.division());
  second_.back().move(motion, at_motion.second.back(), ranks_.division());
  list.build(at_motion.first.back().x, at_motion.second.back().x, ranks_.division());
  at_motion.list = &list;
}

/// Chooses grades, moves the finer points, and updates all weights. The coarsest points of the list
/// have to be moved already.
template <int D>
void PairVisits<D>::bring_others(const Motion& motion, VisitedPair<D>& at_motion) const {
  if (grades() > 1)
    at_motion.facets.choose(*at_motion.list, at_motion.first.back(), at_motion.second.back());
  for (std::size_t g = 0; g < grades(); ++g) {
    const auto first = at_motion.of_first(g).clusters, second = at_motion.of_second(g).clusters;
    if (g + 1 < grades()) {
      first_[g].move(first, motion, at_motion.first[g], ranks_.division());
      second_[g].move(second, motion, at_motion.second[g], ranks_.division());
    }
    first_[g].update_weights(first, motion, at_motion.first[g], ranks_.division());
    second_[g].update_weights(second, motion, at_motion.second[g], ranks_.division());
  }
}

template <int D>
void PairVisits<D>::tell_reads(StepReads& reads) {
  ranks_.learn_halo(reads);
  if (ranks_.are_few()) {
    for (auto* side : {&first_, &second_})
      for (ContactPoints<D>& points : *side) points.tell_reads_alone(reads, ranks_.takes_part());
    return;
  }
  told_list_ = list_.builds();
  if (told_list_ == 0) {
    for (auto* side : {&first_, &second_})
      for (ContactPoints<D>& points : *side) points.tell_reads(reads);
  } else {
    tell_reads(reads, first_, list_.of_first().active);
    tell_reads(reads, second_, list_.of_second().active);
  }
}

/// Registers reads of all grades; `listed` are clusters of the coarsest points.
template <int D>
void PairVisits<D>::tell_reads(StepReads& reads, GradedPoints<D>& side,
                               std::span<const Index> listed) const {
  for (ContactPoints<D>& points : side) {
    const Index each = points.clusters() / side.back().clusters();
    std::vector<Index> clusters;
    for (const Index c : listed)
      for (Index k = 0; k < each; ++k) clusters.push_back(c * each + k);
    points.tell_reads(reads, clusters);
  }
}

template <int D>
std::size_t PairVisits<D>::bytes() const {
  std::size_t n = list_.bytes() + first_since_.bytes() + second_since_.bytes() + now_.bytes();
  for (std::size_t g = 0; g < grades(); ++g) n += first_[g].bytes() + second_[g].bytes();
  return n;
}

template <int D>
Offset PairVisits<D>::point_pairs() const {
  Offset n = 0;
  for (std::size_t g = 0; g < grades(); ++g)
    n += pairs_of(now_.of_first(g)) + pairs_of(now_.of_second(g));
  return n;
}

template struct VisitedPair<2>;
template struct VisitedPair<3>;
template class PairVisits<2>;
template class PairVisits<3>;

}  // namespace meniscus
