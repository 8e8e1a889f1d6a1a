// SPDX-License-Identifier: BSD-3-Clause
// Contacts of small bodies that few ranks compute by themselves (scaling note 2.4).
#pragma once
#include "meniscus/error.hpp"
#include "meniscus/physics/force_term.hpp"

#include <algorithm>
#include <initializer_list>

namespace meniscus {

/// If each body of a contact lies on one rank, only these ranks compute the contact. In a halo they
/// follow all particles that move these surfaces, and each computes the forces on its own bodies
/// and the history of the contact. The rank of the first body reports. Other ranks do nothing.
/// Without a halo each rank computes all. So only the report is exchanged, and lists may differ
/// between ranks.
class ContactRanks {
 public:
  explicit ContactRanks(std::initializer_list<Division> bodies)
      : few_(!meniscus::ranks().alone() &&
             std::all_of(bodies.begin(), bodies.end(),
                         [](const Division& d) { return d.is_whole(); })),
        takes_part_(std::any_of(bodies.begin(), bodies.end(),
                                [](const Division& d) { return d.has_some(); })),
        first_(few_ ? bodies.begin()->only_rank() : 0) {}

  /// True if only the ranks that have the bodies compute the contact while steps are in a halo.
  bool are_few() const { return few_; }
  bool takes_part() const { return takes_part_; }
  /// True if this rank has nothing to do now.
  bool is_absent() const { return only_few_know() && !takes_part_; }
  /// True if the report of this rank is used.
  bool reports() const { return !only_few_know() || meniscus::ranks().rank() == first_; }
  /// The division of loops over contact points.
  const Division& division() const { return division_; }

  /// Has to be called when terms register their reads.
  void learn_halo(StepReads& reads) {
    if (!few_) return;
    reads.when_shared([this](const auto& halo) {
      halo_ = halo;
      division_ = Division::to_each();
    });
  }
  /// The report of add_force() on ranks that take part, empty on others; known_by is set.
  template <class F>
  Report report_of(F&& add_force) const {
    if (!only_few_know()) return add_force();
    Report report;
    try {
      if (takes_part_) report = add_force();
    } catch (const SolveError& e) {
      report.error = e.what();
    }
    report.known_by = first_;
    return report;
  }
  /// Copies the history from the rank of the first body to all ranks.
  template <class T>
  void complete(T& history) const {
    if (few_) meniscus::ranks().hand_out(first_, &history, sizeof history);
  }

 private:
  bool only_few_know() const { return few_ && is_entered(halo_); }

  bool few_, takes_part_;
  int first_;  // rank of the first body
  Division division_ = evenly;
  std::shared_ptr<const Halo> halo_;
};

}  // namespace meniscus
