// SPDX-License-Identifier: BSD-3-Clause
// The sort by buckets: each item once, in the order it came in, buckets one after the other.
#include "meniscus/core/buckets.hpp"

#include <gtest/gtest.h>

#include "support.hpp"

namespace meniscus {
namespace {

TEST(Buckets, KeepTheOrderOfTheirItems) {
  const std::vector<Index> bucket_of{3, 1, 3, 0, 1, 3, 0};
  std::vector<Index> sorted;
  const std::vector<Offset> begin = sort_into_buckets<Offset>(
      5,
      [&](auto&& f) {
        for (std::size_t i = 0; i < bucket_of.size(); ++i) f(bucket_of[i], static_cast<Index>(i));
      },
      [&](Offset count) { sorted.assign(static_cast<std::size_t>(count), -1); },
      [&](Offset k, Index item) { at(sorted, k) = item; });
  EXPECT_EQ(begin, (std::vector<Offset>{0, 2, 4, 4, 7, 7}));
  EXPECT_EQ(sorted, (std::vector<Index>{3, 6, 1, 4, 0, 2, 5}));
}

TEST(Buckets, MayAllBeEmpty) {
  Offset room = -1;
  const std::vector<Offset> begin = sort_into_buckets<Offset>(
      2, [](auto&&) {}, [&](Offset count) { room = count; }, [](Offset, Index) { FAIL(); });
  EXPECT_EQ(begin, (std::vector<Offset>{0, 0, 0}));
  EXPECT_EQ(room, 0);
}

}  // namespace
}  // namespace meniscus
