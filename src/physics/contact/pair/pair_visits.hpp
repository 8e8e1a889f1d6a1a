// SPDX-License-Identifier: BSD-3-Clause
// The contact points of two bodies that may be within reach of each other, and their pairs.
#pragma once
#include "physics/contact/contact_terms.hpp"
#include "physics/contact/pair/contact_list.hpp"
#include "physics/contact/pair/contact_ranks.hpp"
#include "physics/contact/pair/facet_pairs.hpp"
#include "physics/contact/points/moved_since.hpp"

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

  /// Updates now() to this motion. The list of the coarsest points gives the pairs that may be
  /// within reach. Does not allocate while the list is valid.
  void visit(const Motion& motion);
  const VisitedPair<D>& now() const { return now_; }

  /// Returns f(visited) for any motion; allocates memory. The list of now() is used if it is valid.
  template <class F>
  auto look_at(const Motion& motion, F&& f) const {
    VisitedPair<D> at_motion = at_rest();
    std::optional<ContactList<D>> own;
    if (holds(motion))
      move_listed(motion, at_motion);
    else
      make_list(motion, own.emplace(list_.reach(), list_.skin()), at_motion);
    bring_others(motion, at_motion);
    return f(std::as_const(at_motion));
  }

  const ContactRanks& ranks() const { return ranks_; }
  /// Registers the reads of a step: all points if few ranks compute the contact, otherwise the
  /// points of the list if there is one.
  void tell_reads(StepReads& reads);
  /// True if the list was rebuilt since tell_reads().
  bool reads_changed() const { return told_list_ && list_.builds() != *told_list_; }
  std::size_t bytes() const;
  /// Number of pairs of points, counted from both sides.
  Offset point_pairs() const;

 private:
  VisitedPair<D> at_rest() const;
  void tell_reads(StepReads& reads, GradedPoints<D>& side, std::span<const Index> listed) const;
  bool holds(const Motion& motion) const;
  void move_listed(const Motion& motion, VisitedPair<D>& at_motion) const;
  void make_list(const Motion& motion, ContactList<D>& list, VisitedPair<D>& at_motion) const;
  void bring_others(const Motion& motion, VisitedPair<D>& at_motion) const;

  Real reach_;
  FacetGrades grades_;
  GradedPoints<D> first_, second_;
  ContactRanks ranks_;
  ContactList<D> list_;                       // list of the coarsest points
  MovedSince<D> first_since_, second_since_;  // displacements since the list was built
  VisitedPair<D> now_;
  std::optional<std::int64_t> told_list_;  // list_.builds() at tell_reads()
};

}  // namespace meniscus
