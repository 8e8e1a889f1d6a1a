// SPDX-License-Identifier: BSD-3-Clause
// Sums over the entries of rows for each particle, with the same bits for any division of the rows.
#pragma once
#include "parallel/ranks.hpp"

#include <deque>
#include <vector>

namespace meniscus {

/// Adds values in the order of the rows. A rank keeps the values of its rows until the ranks before
/// it have added theirs.
class SumsOverRanks {
 public:
  explicit SumsOverRanks(Index particles) : sums_(static_cast<std::size_t>(particles), 0.0) {}

  /// Adds the value of the next entry in the rows of this rank.
  void add(Index A, Real value) {
    if (ranks().first()) {
      at(sums_, A) += value;
      return;
    }
    particle_.push_back(A);
    value_.push_back(value);
  }

  /// The sums over the rows of all ranks, [particle]. All ranks have to call this.
  std::vector<Real> of_all() {
    for (int rank = 0; rank < ranks().size(); ++rank) {
      if (rank == ranks().rank()) add_kept();
      ranks().hand_out(rank, sums_.data(), sums_.size() * sizeof(Real));
    }
    return std::move(sums_);
  }

 private:
  void add_kept() {
    for (std::size_t e = 0; e < particle_.size(); ++e) at(sums_, particle_[e]) += value_[e];
  }

  std::vector<Real> sums_;
  std::deque<Index> particle_;  // of the values kept
  std::deque<Real> value_;
};

}  // namespace meniscus
