// SPDX-License-Identifier: BSD-3-Clause
// Gathers items that belong to different ranks in one exchange, e.g. the chunks of several bodies.
#pragma once
#include "parallel/divided.hpp"

#include <vector>

namespace meniscus {

/// A list of items that belong to one rank each, in any order of ranks.
class SharedItems {
 public:
  void clear() { rank_.clear(); }
  void add(int rank) { rank_.push_back(rank); }
  /// Adds n items of a division.
  void add(Index n, const Division& division) {
    for (Index k = 0; k < n; ++k) add(division.rank_of_item(n, k));
  }

  /// Gathers values[item], of `bytes_per_value` bytes each, on all ranks. All ranks have to call
  /// this.
  void complete(void* values, std::size_t bytes_per_value);

 private:
  std::vector<int> rank_;           // [item]
  std::vector<std::byte> sorted_;   // values sorted by rank
  std::vector<std::size_t> begin_;  // in bytes, [rank + 1]
  std::vector<std::size_t> next_;   // where the next value of a rank goes, [rank]
};

}  // namespace meniscus
