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
      work_({first.body.division, second.body.division}),
      list_(reach_ + overhang(first, second, grades_), choice.skin * law.sigma0),
      first_moves_(work_.rows(first.body.division)),
      second_moves_(work_.rows(second.body.division)),
      now_(at_rest()) {}

template <int D>
VisitedPair<D> PairVisits<D>::at_rest() const {
  return {places_at_rest(first_), places_at_rest(second_),
          FacetPairs<D>(grades_, clusters_per_facet(first_), reach_), &list_};
}

/// True if the list has all pairs within reach at a motion that is known everywhere.
template <int D>
bool PairVisits<D>::holds(const Motion& motion) const {
  const Points &first = first_.back(), &second = second_.back();
  return first_since_.farthest(first, first.particles(), motion) +
             second_since_.farthest(second, second.particles(), motion) <=
         list_.skin() * (1 - 1e-12);
}

template <int D>
std::array<Gathered, 2> PairVisits<D>::moves(const Motion& motion) {
  if (Real* const mine = first_moves_.mine())
    *mine = first_since_.farthest(first_.back(), first_.back().own_particles(work_), motion);
  if (Real* const mine = second_moves_.mine())
    *mine = second_since_.farthest(second_.back(), second_.back().own_particles(work_), motion);
  return {first_moves_.gathered(), second_moves_.gathered()};
}

template <int D>
bool PairVisits<D>::covers() {
  const auto farthest = [](const PartTally<Real>& moves) {
    return *std::max_element(moves.begin(), moves.end());
  };
  covers_ = farthest(first_moves_) + farthest(second_moves_) <= list_.skin() * (1 - 1e-12);
  return covers_ && !reads_changed();
}

template <int D>
std::array<Gathered, 2> PairVisits<D>::place(const Motion& motion) {
  return {first_.back().place(placed_first(), work_, placed(), motion, now_.first.back()),
          second_.back().place(placed_second(), work_, placed(), motion, now_.second.back())};
}

template <int D>
void PairVisits<D>::choose(const Motion& motion) {
  first_.back().take_placed(placed_first(), work_, placed(), now_.first.back());
  second_.back().take_placed(placed_second(), work_, placed(), now_.second.back());
  if (!covers_) begin_list(motion);
  if (grades() > 1) now_.facets.choose(list_, now_.first.back(), now_.second.back());
}

/// Makes the list of all coarsest points, which have been moved.
template <int D>
void PairVisits<D>::begin_list(const Motion& motion) {
  list_.build(now_.first.back().x, now_.second.back().x);
  first_since_.begin(first_.back(), motion);
  second_since_.begin(second_.back(), motion);
}

template <int D>
std::span<const Gathered> PairVisits<D>::place_grades(const Motion& motion) {
  placed_.clear();
  for (std::size_t g = 0; g < grades(); ++g) {
    placed_.push_back(first_[g].place(now_.of_first(g).clusters, work_, Points::Placed::weights,
                                      motion, now_.first[g]));
    placed_.push_back(second_[g].place(now_.of_second(g).clusters, work_, Points::Placed::weights,
                                       motion, now_.second[g]));
  }
  return placed_;
}

template <int D>
void PairVisits<D>::take_grades() {
  for (std::size_t g = 0; g < grades(); ++g) {
    first_[g].take_placed(now_.of_first(g).clusters, work_, Points::Placed::weights, now_.first[g]);
    second_[g].take_placed(now_.of_second(g).clusters, work_, Points::Placed::weights,
                           now_.second[g]);
  }
}

template <int D>
void PairVisits<D>::visit(const Motion& motion) {
  if (holds(motion)) {
    move_listed(motion, now_);
  } else {
    make_list(motion, list_, now_);
    first_since_.begin(first_.back(), motion);
    second_since_.begin(second_.back(), motion);
  }
  move_others(motion, now_);
}

/// Moves the coarsest points that are in the list.
template <int D>
void PairVisits<D>::move_listed(const Motion& motion, VisitedPair<D>& at_motion) const {
  first_.back().move(list_.of_first().active, motion, at_motion.first.back());
  second_.back().move(list_.of_second().active, motion, at_motion.second.back());
}

/// Moves all coarsest points and builds a list of them.
template <int D>
void PairVisits<D>::make_list(const Motion& motion, ContactList<D>& list,
                              VisitedPair<D>& at_motion) const {
  first_.back().move(motion, at_motion.first.back());
  second_.back().move(motion, at_motion.second.back());
  list.build(at_motion.first.back().x, at_motion.second.back().x);
  at_motion.list = &list;
}

/// Chooses grades, moves the finer points, and updates all weights. The coarsest points of the list
/// have to be moved already.
template <int D>
void PairVisits<D>::move_others(const Motion& motion, VisitedPair<D>& at_motion) const {
  if (grades() > 1)
    at_motion.facets.choose(*at_motion.list, at_motion.first.back(), at_motion.second.back());
  for (std::size_t g = 0; g < grades(); ++g) {
    const auto first = at_motion.of_first(g).clusters, second = at_motion.of_second(g).clusters;
    if (g + 1 < grades()) {
      first_[g].move(first, motion, at_motion.first[g]);
      second_[g].move(second, motion, at_motion.second[g]);
    }
    first_[g].update_weights(first, motion, at_motion.first[g]);
    second_[g].update_weights(second, motion, at_motion.second[g]);
  }
}

template <int D>
void PairVisits<D>::list_reads(StepReads& reads) {
  if (work_.is_of_few()) {
    for (auto* side : {&first_, &second_})
      for (const Points& points : *side)
        work_.takes_part() ? points.list_reads(reads) : points.list_sums(reads);
    return;
  }
  read_list_ = list_.builds();
  if (read_list_ == 0) {
    for (auto* side : {&first_, &second_})
      for (const Points& points : *side) points.list_reads(reads);
  } else {
    list_reads(reads, first_, list_.of_first().active);
    list_reads(reads, second_, list_.of_second().active);
  }
}

/// Registers reads of all grades; `listed` are clusters of the coarsest points.
template <int D>
void PairVisits<D>::list_reads(StepReads& reads, const GradedPoints<D>& side,
                               std::span<const Index> listed) const {
  for (const Points& points : side) {
    const Index each = points.clusters() / side.back().clusters();
    std::vector<Index> clusters;
    for (const Index c : listed)
      for (Index k = 0; k < each; ++k) clusters.push_back(c * each + k);
    points.list_reads(reads, clusters);
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
