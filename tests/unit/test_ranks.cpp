// SPDX-License-Identifier: BSD-3-Clause
// An exception on one rank is thrown on all ranks.
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"
#include "some_ranks.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <new>

namespace meniscus::test_ranks {
namespace {

/// Ranks run one after the other. Rank 0 stores the values that it hands out, and rank 1 reads
/// them.
class Broadcast final : public OneOfRanks {
 public:
  static inline std::deque<std::string> sent;
  void hand_out(int from, void* values, std::size_t bytes) override {
    ASSERT_EQ(from, 0);
    if (number == 0) {
      sent.emplace_back(static_cast<const char*>(values), bytes);
    } else {
      ASSERT_EQ(sent.front().size(), bytes);
      std::memcpy(values, sent.front().data(), bytes);
      sent.pop_front();
    }
  }
};

/// Throws `error` on the first rank. Both ranks must throw `Expected` with the words of the first.
template <class Expected, class Error>
void expect_on_both(const Error& error, const std::string& words) {
  as_each_of<Broadcast>(2, [&](int rank) {
    try {
      on_first_rank([&] { throw error; });
      ADD_FAILURE() << "rank " << rank << " goes on";
    } catch (const Expected& thrown) {
      EXPECT_EQ(thrown.what(), words) << "rank " << rank;
    } catch (const std::exception& other) {
      ADD_FAILURE() << "rank " << rank << ": " << other.what();
    }
  });
  EXPECT_TRUE(Broadcast::sent.empty());
}

TEST(OnFirstRank, WhatIsThrownThereIsThrownOnAll) {
  expect_on_both<FileError>(FileError("no disk"), "no disk");
  expect_on_both<InputError>(InputError("no sense"), "no sense");
  expect_on_both<SolveError>(SolveError("no state"), "no state");
  expect_on_both<Interrupted>(Interrupted(), Interrupted().what());
  expect_on_both<OutOfMemory>(std::bad_alloc(), OutOfMemory().what());
  expect_on_both<std::runtime_error>(std::logic_error("no reason"), "no reason");
  expect_on_both<std::runtime_error>(std::out_of_range("no place"), "no place");
}

TEST(RequireAlike, RefusesATextThatOnlyOneRankHas) {
  as_each_of<Broadcast>(2, [](int) { require_alike("a", "scene"); });
  as_each_of<Broadcast>(2, [](int rank) {
    if (rank == 0) return require_alike("a", "scene 's.toml'");
    EXPECT_THROW(require_alike("b", "scene 's.toml'"), FileError);
  });
}

}  // namespace
}  // namespace meniscus::test_ranks
