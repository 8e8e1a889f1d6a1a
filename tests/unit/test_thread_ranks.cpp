// SPDX-License-Identifier: BSD-3-Clause
// Ranks as threads of one process: collective functions, exchanges, and ranks that fail.
#include "meniscus/error.hpp"
#include "parallel/divided.hpp"
#include "parallel/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace meniscus::test_thread_ranks {
namespace {

/// Adds up what each rank finds wrong.
int wrong_on_all(int size, const std::function<bool(int rank)>& is_right) {
  std::vector<int> wrong(static_cast<std::size_t>(size), 0);
  as_ranks(size, [&] { at(wrong, ranks().rank()) = !is_right(ranks().rank()); });
  return std::accumulate(wrong.begin(), wrong.end(), 0);
}

TEST(ThreadRanks, KnowTheirNumberAndTheLargestValue) {
  EXPECT_EQ(wrong_on_all(3,
                         [](int rank) {
                           return ranks().size() == 3 &&
                                  ranks().largest(rank == 1 ? 7 : -rank) == 7 &&
                                  ranks().largest(-rank - 1) == -1;
                         }),
            0);
  EXPECT_TRUE(ranks().alone());
}

TEST(ThreadRanks, GatherWhatEachOfThemHas) {
  EXPECT_EQ(wrong_on_all(3,
                         [](int rank) {
                           constexpr Index n = 100;
                           std::vector<Real> values(n, -1);
                           const OwnItems own = evenly.own_items(n);
                           for (Index k = own.begin; k < own.end; ++k) at(values, k) = k;
                           evenly.complete_items(n, values.data(), sizeof(Real));
                           Real handed = rank == 2 ? 5 : 0;
                           ranks().hand_out(2, &handed, sizeof handed);
                           for (Index k = 0; k < n; ++k)
                             if (at(values, k) != k) return false;
                           return handed == 5;
                         }),
            0);
}

/// Each rank has one root, and needs the roots of the two other ranks.
TEST(ThreadRanks, BringRootsToLeaves) {
  EXPECT_EQ(wrong_on_all(3,
                         [](int rank) {
                           std::vector<Leaf> leaves;
                           for (int r = 0; r < 3; ++r)
                             if (r != rank) leaves.push_back({r, r, r});
                           const auto exchange = ranks().exchange(3, leaves);
                           std::vector<Real> values(3, -1);
                           for (int round = 0; round < 100; ++round) {
                             at(values, rank) = 10 * round + rank;
                             exchange->bring(values.data(), values.data(), sizeof(Real));
                             for (int r = 0; r < 3; ++r)
                               if (at(values, r) != 10 * round + r) return false;
                           }
                           return true;
                         }),
            0);
}

TEST(ThreadRanks, EndTogetherIfOneOfThemFailsAlone) {
  const auto fail = [] {
    if (ranks().rank() == 1) throw SolveError("on rank 1");
    ranks().largest(0);
    ADD_FAILURE() << "rank " << ranks().rank() << " has gone on without rank 1";
  };
  try {
    as_ranks(3, fail);
    FAIL() << "the failure is lost";
  } catch (const SolveError& e) {
    EXPECT_STREQ(e.what(), "on rank 1");
  }
}

}  // namespace
}  // namespace meniscus::test_thread_ranks
