// SPDX-License-Identifier: BSD-3-Clause
// Counting sort: items sorted by the number of their bucket.
#pragma once
#include "numbers/types.hpp"

#include <numeric>
#include <vector>

namespace meniscus {

/// Sorts items by bucket, 0 .. count - 1; within a bucket their order is kept. `visit(f)` is called
/// twice and has to call f(bucket, item) for every item, in the same order both times. Between the
/// two passes make_room(number of items) is called. In the second pass put(k, item) is called with
/// the place k of each item. Returns the begin of each bucket, and the number of items as last
/// entry.
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
