// SPDX-License-Identifier: BSD-3-Clause
// The ranks that make a contact of small bodies by themselves (scaling note 2.4).
#pragma once
#include "meniscus/core/error.hpp"
#include "meniscus/physics/force_term.hpp"

#include <algorithm>
#include <initializer_list>

namespace meniscus {

/// Where all bodies of a contact are whole, the ranks that have them take part: in a halo they
/// follow all that moves these surfaces, and each of them does what it needs for the forces on its
/// own bodies and for the history of the contact, that of the first body all, since it reports.
/// Others do nothing. Out of a halo each rank does all. So nothing is sent but the report, and
/// what a list has does not need to be the same on all ranks.
class ContactRanks {
 public:
  explicit ContactRanks(std::initializer_list<Division> bodies)
      : few_(!meniscus::ranks().alone() &&
             std::all_of(bodies.begin(), bodies.end(),
                         [](const Division& d) { return d.is_whole(); })),
        takes_part_(std::any_of(bodies.begin(), bodies.end(),
                                [](const Division& d) { return d.has_some(); })),
        first_(few_ ? bodies.begin()->only_rank() : 0) {}

  /// Whether only those that have the bodies make it, as soon as steps are shared.
  bool are_few() const { return few_; }
  bool takes_part() const { return takes_part_; }
  /// Has nothing to do now.
  bool is_absent() const { return only_few_know() && !takes_part_; }
  /// Whether all that the contact says is asked of this rank.
  bool reports() const { return !only_few_know() || meniscus::ranks().rank() == first_; }
  /// By which loops over contact points are divided.
  const Division& division() const { return division_; }

  /// When terms say what they read.
  void learn_halo(StepReads& reads) {
    if (!few_) return;
    reads.when_shared([this](const auto& halo) {
      halo_ = halo;
      division_ = Division::to_each();
    });
  }
  /// What add_force() says if it is not absent, with who knows it.
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
  /// Brings what the rank of the first body has kept.
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
