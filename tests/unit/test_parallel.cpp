// SPDX-License-Identifier: BSD-3-Clause
// Chunks of rows cover each row once, in a number that depends on the size alone, not on the
// threads; items in buckets keep their order.
#include "numbers/buckets.hpp"
#include "parallel/parallel.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace meniscus::test_parallel {
namespace {

TEST(Chunks, FollowFromTheSizeAlone) {
  EXPECT_EQ(chunk_count(0), 16);
  EXPECT_EQ(chunk_count(16 * 2048), 16);
  EXPECT_EQ(chunk_count(100 * 2048), 100);
  EXPECT_EQ(chunk_count(std::numeric_limits<Index>::max()), 4096);
  for (const Index n : {0, 1, 15, 16, 1000, 40000, 1 << 27}) {
    EXPECT_EQ(chunk_begin(n, 0), 0);
    EXPECT_EQ(chunk_begin(n, chunk_count(n)), n);
    for (int c = 0; c < chunk_count(n); ++c) EXPECT_LE(chunk_begin(n, c), chunk_begin(n, c + 1));
  }
}

/// A sum with more rows than the smallest number of chunks covers.
TEST(Chunks, SumsHaveTheSameBitsForAnyThreads) {
  constexpr Index n = 50 * 2048 + 77;
  const auto sum = [&] {
    return parallel_sum(n, 0.0, [](Index i) { return std::sin(static_cast<Real>(i)); });
  };
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Real one = sum();
  for (const int threads : {2, 3, 5}) {
    omp_set_num_threads(threads);
    EXPECT_EQ(sum(), one) << threads;
  }
  omp_set_num_threads(before);
  // The exact sum of sin i is sin(n/2) sin((n - 1)/2) / sin(1/2).
  EXPECT_NEAR(one, std::sin(n / 2.0) * std::sin((n - 1) / 2.0) / std::sin(0.5), 1e-9);
}

std::vector<Index> taken_by_one(Index parts) {
  LoopShares shares(parts);
  std::vector<Index> taken;
  for (Index part = shares.take(); part >= 0; part = shares.take()) taken.push_back(part);
  return taken;
}

/// Outside parallel loops, the caller is the first thread and the only one.
TEST(LoopShares, GiveAThreadItsOwnPartsFirstAndThenTheEndsOfOthers) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(3);
  EXPECT_EQ(taken_by_one(10), (std::vector<Index>{0, 1, 2, 5, 4, 3, 9, 8, 7, 6}));
  EXPECT_EQ(taken_by_one(1), (std::vector<Index>{0}));
  EXPECT_EQ(taken_by_one(0), (std::vector<Index>{}));
  omp_set_num_threads(before);
}

TEST(LoopShares, GiveEachPartOnceToAnyThreads) {
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 5, 70}) {
    omp_set_num_threads(threads);
    std::vector<int> times(1000, 0);
    parallel_for(
        1000, [&](Index i) { ++at(times, i); }, 3);
    EXPECT_EQ(times, std::vector<int>(1000, 1)) << threads;
  }
  omp_set_num_threads(before);
}

TEST(Sweeps, OverFewRowsWakeNoThread) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(3);
  const auto threads_of_sweep = [](Index n) {
    int threads = 0;
    sweep(n, [&](Index begin, Index) {
      if (begin == 0) threads = omp_get_num_threads();
    });
    return threads;
  };
  EXPECT_EQ(threads_of_sweep(16), 1);
  EXPECT_EQ(threads_of_sweep(4096), 1);
  EXPECT_EQ(threads_of_sweep(4097), 3);
  omp_set_num_threads(before);
}

TEST(Loops, ThrowWhatTheLeastIndexThrewForAnyThreads) {
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 4}) {
    omp_set_num_threads(threads);
    try {
      parallel_for(
          1000,
          [](Index i) {
            if (i >= 313) throw std::runtime_error(std::to_string(i));
          },
          1);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "313");
    }
  }
  omp_set_num_threads(before);
}

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
}  // namespace meniscus::test_parallel
