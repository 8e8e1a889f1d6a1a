// SPDX-License-Identifier: BSD-3-Clause
// Items sorted by a number that each of them has.
#pragma once
#include "meniscus/core/types.hpp"

#include <numeric>
#include <vector>

namespace meniscus {

/// Sorts items by the bucket they belong to, 0 .. count - 1; in a bucket they keep their order.
/// `visit(f)` is called twice and calls f(bucket, item) for every item, in the same order;
/// in between, `make_room` is told the number of items, and `put(k, item)` then the place k of
/// each. Returns the places at which the buckets begin, and behind them the number of items.
template <class Place, class Visit, class MakeRoom, class Put>
std::vector<Place> sort_into_buckets(Index count, Visit&& visit, MakeRoom&& make_room, Put&& put) {
  std::vector<Place> begin(static_cast<std::size_t>(count) + 1, 0);
  visit([&](Index bucket, const auto&) { ++at(begin, bucket + 1); });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  make_room(begin.back());
  std::vector<Place> next(begin.begin(), begin.end() - 1);
  visit([&](Index bucket, const auto& item) { put(at(next, bucket)++, item); });
  return begin;
}

}  // namespace meniscus
