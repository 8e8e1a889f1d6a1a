// SPDX-License-Identifier: BSD-3-Clause
// Results of a force term per chunk of rows, beside forces, and the exchange that brings those of
// all terms to all ranks at once.
#pragma once
#include "parallel/chunk_sums.hpp"
#include "parallel/shared_items.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace meniscus {

struct ChunkReport {
  Real heat = 0;            ///< power turned into heat
  Real external_power = 0;  ///< power supplied by explicit dependence on time
  Real energy = 0;          ///< stored energy, if requested
  Index failed = nowhere;   ///< first row with a failure, or nowhere

  static constexpr Index nowhere = std::numeric_limits<Index>::max();
};

/// The reports of all chunks of a set of rows, [chunk].
class ChunkReports {
 public:
  explicit ChunkReports(const ChunkSums& chunk_sums)
      : division_(chunk_sums.division()), said_(static_cast<std::size_t>(chunk_sums.chunks())) {}

  ChunkReport& operator[](int chunk) { return at(said_, chunk); }
  Index size() const { return static_cast<Index>(said_.size()); }
  const Division& division() const { return division_; }
  auto begin() const { return said_.begin(); }
  auto end() const { return said_.end(); }
  auto begin() { return said_.begin(); }
  auto end() { return said_.end(); }

  /// Gathers the reports of all ranks. All ranks have to call this.
  void complete() { division_.complete_items(size(), said_.data(), sizeof said_[0]); }

 private:
  Division division_;
  std::vector<ChunkReport> said_;
};

/// Gathers the reports of several sets of rows in one exchange.
class ReportExchange {
 public:
  /// All ranks have to call this with the same sets.
  void complete(const std::vector<ChunkReports*>& sets) {
    if (sets.empty()) return;
    items_.clear();
    all_.clear();
    for (const ChunkReports* set : sets) {
      items_.add(set->size(), set->division());
      all_.insert(all_.end(), set->begin(), set->end());
    }
    items_.complete(all_.data(), sizeof all_[0]);
    auto next = all_.cbegin();
    for (ChunkReports* set : sets) {
      std::copy_n(next, set->size(), set->begin());
      next += set->size();
    }
  }

 private:
  SharedItems items_;
  std::vector<ChunkReport> all_;
};

}  // namespace meniscus
