// SPDX-License-Identifier: BSD-3-Clause
// The division of the work between two bodies among ranks (scaling note 2.4).
#pragma once
#include "parallel/gathered.hpp"

#include <algorithm>
#include <initializer_list>
#include <vector>

namespace meniscus {

/// The work between bodies. If each body lies on one rank, only these ranks take part: each follows
/// all particles that move the surfaces and does the whole work for the forces on its own bodies,
/// and the rank of the first body reports. Otherwise all ranks share the work.
class SharedWork {
 public:
  explicit SharedWork(std::initializer_list<Division> bodies)
      : few_(!ranks().alone() && std::all_of(bodies.begin(), bodies.end(),
                                             [](const Division& d) { return d.is_whole(); })),
        takes_part_(std::any_of(bodies.begin(), bodies.end(),
                                [](const Division& d) { return d.has_some(); })),
        first_(*bodies.begin()) {}

  /// Work that all ranks share.
  static SharedWork of_all() { return SharedWork({evenly}); }

  /// True if the ranks that take part need nothing from others.
  bool is_of_few() const { return few_; }
  bool takes_part() const { return takes_part_; }
  /// True if this rank computes the report.
  bool reports() const { return !few_ || first_.has_some(); }
  /// The part of this rank in rows that are divided by `of_body`, and in n items.
  Division rows(const Division& of_body) const { return few_ ? Division::to_each() : of_body; }
  Portions items(Index n) const { return (few_ ? Division::to_each() : evenly).items(n); }
  /// A value that is computed on the reporting ranks.
  template <class T>
  Gathered reported(T* value) const {
    return {value, (few_ ? first_ : Division::to_each()).items(1)};
  }

 private:
  bool few_, takes_part_;
  Division first_;  // of the first body
};

/// One result of each rank that has rows of a division.
template <class T>
class PartTally {
 public:
  PartTally() = default;
  explicit PartTally(const Division& division)
      : division_(division.is_to_each() ? evenly : division),
        of_part_(static_cast<std::size_t>(division.is_whole() ? 1 : ranks().size())) {}

  /// The result of this rank; null if it has no rows.
  T* mine() {
    const ItemRange own = shares().own();
    return own.begin < own.end ? &at(of_part_, own.begin) : nullptr;
  }
  auto begin() const { return of_part_.begin(); }
  auto end() const { return of_part_.end(); }
  Gathered gathered() { return {of_part_.data(), shares()}; }

 private:
  Portions shares() const { return division_.items(static_cast<Index>(of_part_.size())); }

  Division division_;
  std::vector<T> of_part_;
};

}  // namespace meniscus
