// SPDX-License-Identifier: BSD-3-Clause
// Items of which each belongs to some rank, brought to all at once: the chunks of several sets of
// rows or bodies.
#pragma once
#include "meniscus/core/divided.hpp"

#include <vector>

namespace meniscus {

/// Items that each are of one rank, whichever comes next.
class SharedItems {
 public:
  void clear() { rank_.clear(); }
  void add(int rank) { rank_.push_back(rank); }
  /// n more, divided so.
  void add(Index n, const Division& division) {
    for (Index k = 0; k < n; ++k) add(division.rank_of_item(n, k));
  }

  /// Brings values of so many bytes, [item], of the others. All ranks call this.
  void complete(void* values, std::size_t bytes_per_value);

 private:
  std::vector<int> rank_;           // [item]
  std::vector<std::byte> sorted_;   // values, those of a rank after those of the one before
  std::vector<std::size_t> begin_;  // in bytes, [rank + 1]
  std::vector<std::size_t> next_;   // while they are sorted, [rank]
};

}  // namespace meniscus
