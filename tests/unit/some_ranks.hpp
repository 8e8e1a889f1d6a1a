// SPDX-License-Identifier: BSD-3-Clause
// Tests a single rank of several, without the others.
#pragma once
#include "parallel/ranks.hpp"

#include <memory>

namespace meniscus {

/// One of several ranks. The other ranks send nothing: values expected from them stay unchanged.
class OneOfRanks : public Ranks {
 public:
  static inline int number = 0, all = 1;
  int rank() const override { return number; }
  int size() const override { return all; }
};

/// Calls f(rank) as each rank of `size`.
template <class Rank = OneOfRanks, class F>
void as_each_of(int size, F&& f) {
  register_ranks([]() -> std::unique_ptr<Ranks> { return std::make_unique<Rank>(); });
  join_ranks();
  OneOfRanks::all = size;
  for (OneOfRanks::number = 0; OneOfRanks::number < size; ++OneOfRanks::number)
    f(OneOfRanks::number);
  register_ranks([] { return std::make_unique<Ranks>(); });
  join_ranks();
}

}  // namespace meniscus
