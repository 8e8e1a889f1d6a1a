// SPDX-License-Identifier: BSD-3-Clause
// The contact points of two bodies that may be within reach of each other, and their pairs.
#pragma once
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/pair/contact_list.hpp"
#include "physics/contact/pair/facet_pairs.hpp"
#include "physics/contact/points/moved_since.hpp"

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace meniscus {

/// The contact points of a body, [grade]: the most points per facet first.
template <int D>
using GradedPoints = std::vector<ContactPoints<D>>;

/// Points of both bodies at a motion, [grade]. Only points that may be within reach of the other
/// body are up to date.
template <int D>
struct VisitedPair {
  std::vector<ContactPlaces<D>> first, second;
  FacetPairs<D> facets;        ///< used if there are several grades
  const ContactList<D>* list;  ///< list of the coarsest points

  /// The clusters of a grade that have partners, and their partners.
  FacetRows<D> of_first(std::size_t grade) const {
    return first.size() == 1 ? all_of(list->of_first()) : facets.of_first(grade);
  }
  FacetRows<D> of_second(std::size_t grade) const {
    return first.size() == 1 ? all_of(list->of_second()) : facets.of_second(grade);
  }
  std::size_t bytes() const;

 private:
  static FacetRows<D> all_of(const typename ContactList<D>::Rows& rows) {
    return {&rows, 1, rows.active};
  }
};

/// The points of two bodies and the result of the last visit.
template <int D>
class PairVisits {
 public:
  /// Uses points of volumes for the form `volume`, otherwise points of surfaces.
  PairVisits(const ContactBody<D>& first, const ContactBody<D>& second,
             const Interaction& interaction, const ContactLaw& law, const ContactChoice& choice);
  PairVisits(const PairVisits&) = delete;
  PairVisits& operator=(const PairVisits&) = delete;

  std::size_t grades() const { return first_.size(); }
  ContactPoints<D>& first(std::size_t grade) { return first_[grade]; }
  ContactPoints<D>& second(std::size_t grade) { return second_[grade]; }
  const ContactPoints<D>& first(std::size_t grade) const { return first_[grade]; }
  const ContactPoints<D>& second(std::size_t grade) const { return second_[grade]; }
  const SharedWork& work() const { return work_; }

  // The parts of a visit, in order; arrays that a part returns are to be gathered before the next
  // part. The list of the coarsest points gives the pairs that may be within reach. Nothing is
  // allocated while the list is valid.

  /// How far the points have moved since the list was made; to be gathered before covers().
  std::array<Gathered, 2> moves(const Motion& motion);
  /// True if the list has all pairs within reach, and this process reads the motion of its points.
  bool covers();
  /// Moves the coarsest points in the list, or all of them if it does not cover the motion.
  std::array<Gathered, 2> place(const Motion& motion);
  /// Makes a new list if necessary, and chooses the grades of facets.
  void choose(const Motion& motion);
  /// Moves the points of all grades, with their weights.
  std::span<const Gathered> place_grades(const Motion& motion);
  /// Ends the visit of several grades.
  void take_grades();

  /// Makes all parts for a motion that is known everywhere.
  void visit(const Motion& motion);
  const VisitedPair<D>& now() const { return now_; }

  /// Returns f(visited) for any motion; allocates memory. The list of now() is used if it is valid.
  template <class F>
  auto look_at(const Motion& motion, F&& f) const {
    VisitedPair<D> at_motion = at_rest();
    ContactList<D> list(list_.reach(), list_.skin());
    if (holds(motion))
      move_listed(motion, at_motion);
    else
      make_list(motion, list, at_motion);
    move_others(motion, at_motion);
    return f(std::as_const(at_motion));
  }

  /// Registers the reads of a force: all points if the work is of few, otherwise the points of the
  /// list if there is one.
  void list_reads(StepReads& reads);
  /// True if the list was rebuilt since list_reads().
  bool reads_changed() const { return read_list_ && list_.builds() != *read_list_; }
  std::size_t bytes() const;
  /// Number of pairs of points, counted from both sides.
  Offset point_pairs() const;

 private:
  using Points = ContactPoints<D>;

  VisitedPair<D> at_rest() const;
  void list_reads(StepReads& reads, const GradedPoints<D>& side,
                  std::span<const Index> listed) const;
  bool holds(const Motion& motion) const;
  void move_listed(const Motion& motion, VisitedPair<D>& at_motion) const;
  void make_list(const Motion& motion, ContactList<D>& list, VisitedPair<D>& at_motion) const;
  void move_others(const Motion& motion, VisitedPair<D>& at_motion) const;
  void begin_list(const Motion& motion);
  /// The values that place() computes.
  typename Points::Placed placed() const {
    return grades() == 1 ? Points::Placed::weights : Points::Placed::positions;
  }
  std::span<const Index> placed_first() const {
    return covers_ ? std::span<const Index>(list_.of_first().active) : first_.back().all();
  }
  std::span<const Index> placed_second() const {
    return covers_ ? std::span<const Index>(list_.of_second().active) : second_.back().all();
  }

  Real reach_;
  FacetGrades grades_;
  GradedPoints<D> first_, second_;
  SharedWork work_;
  ContactList<D> list_;                       // list of the coarsest points
  MovedSince<D> first_since_, second_since_;  // displacements since the list was built
  PartTally<Real> first_moves_, second_moves_;
  bool covers_ = false;           // at the last visit
  std::vector<Gathered> placed_;  // [grade, first or second] of the last visit
  VisitedPair<D> now_;
  std::optional<std::int64_t> read_list_;  // list_.builds() at list_reads()
};

}  // namespace meniscus
