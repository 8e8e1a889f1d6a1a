// SPDX-License-Identifier: BSD-3-Clause
// Sorts items by rank, exchanges them, and puts them back.
#include "parallel/shared_items.hpp"

#include <cstring>
#include <numeric>

namespace meniscus {

void SharedItems::complete(void* values, std::size_t bytes_per_value) {
  const auto of_ranks = static_cast<std::size_t>(ranks().size());
  begin_.assign(of_ranks + 1, 0);
  for (const int rank : rank_) begin_[static_cast<std::size_t>(rank) + 1] += bytes_per_value;
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  sorted_.resize(begin_.back());
  auto* bytes = static_cast<std::byte*>(values);
  // Calls copy(place in sorted_, place in values) for the items of this rank, or for all others.
  const auto for_items = [&](bool own, auto&& copy) {
    next_.assign(begin_.begin(), begin_.end() - 1);
    for (std::size_t k = 0; k < rank_.size(); ++k) {
      std::size_t& place = at(next_, rank_[k]);
      if ((rank_[k] == ranks().rank()) == own)
        copy(sorted_.data() + place, bytes + k * bytes_per_value);
      place += bytes_per_value;
    }
  };
  for_items(true, [&](std::byte* sorted, const std::byte* value) {
    std::memcpy(sorted, value, bytes_per_value);
  });
  ranks().gather(sorted_.data(), begin_);
  for_items(false, [&](const std::byte* sorted, std::byte* value) {
    std::memcpy(value, sorted, bytes_per_value);
  });
}

}  // namespace meniscus
