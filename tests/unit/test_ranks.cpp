// SPDX-License-Identifier: BSD-3-Clause
// An exception on one rank is thrown on all ranks.
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"
#include "parallel/thread_ranks.hpp"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace meniscus::test_ranks {
namespace {

/// Throws `error` on the first rank. Both ranks must throw `Expected` with the words of the first.
template <class Expected, class Error>
void expect_on_both(const Error& error, const std::string& words) {
  as_ranks(2, [&] {
    try {
      on_first_rank([&] { throw error; });
      ADD_FAILURE() << "rank " << ranks().rank() << " goes on";
    } catch (const Expected& thrown) {
      EXPECT_EQ(thrown.what(), words) << "rank " << ranks().rank();
    } catch (const std::exception& other) {
      ADD_FAILURE() << "rank " << ranks().rank() << ": " << other.what();
    }
  });
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
  as_ranks(2, [] { require_alike("a", "scene"); });
  as_ranks(2, [] {
    EXPECT_THROW(require_alike(ranks().first() ? "a" : "b", "scene 's.toml'"), FileError);
  });
}

}  // namespace
}  // namespace meniscus::test_ranks
