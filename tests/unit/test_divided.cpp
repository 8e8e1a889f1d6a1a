// SPDX-License-Identifier: BSD-3-Clause
// The rows that a rank computes equal the rows of a run with one process.
#include "body/body.hpp"
#include "meniscus/error.hpp"
#include "parallel/divided.hpp"
#include "parallel/shared_items.hpp"
#include "parallel/shared_work.hpp"
#include "parallel/thread_ranks.hpp"
#include "straight_grid.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstring>

namespace meniscus::test_divided {
namespace {

/// Calls f(rank) on each of `size` ranks.
template <class F>
void on_ranks(int size, F&& f) {
  as_ranks(size, [&] { f(ranks().rank()); });
}

TEST(Divided, EachRowIsOfOneRankInOrder) {
  for (const Index n : {0, 1, 5, 100, 40000})
    for (const int size : {1, 2, 3, 20})
      on_ranks(size, [&](int rank) {
        const OwnItems own = evenly.own_rows(n);
        EXPECT_EQ(own.begin, evenly.first_row(n, rank));
        EXPECT_EQ(own.end, rank + 1 < size ? evenly.first_row(n, rank + 1) : n);
        for (Index row = own.begin; row < own.end; row += 7)
          EXPECT_EQ(evenly.rank_of_row(n, row), rank);
      });
}

/// The rank that has all rows of each body; -1 if each rank has some.
std::vector<int> owners(const std::vector<Index>& rows) {
  std::vector<int> found;
  const std::vector<Division> divisions = divide(rows);
  for (std::size_t b = 0; b < rows.size(); ++b) {
    const int first = divisions[b].rank_of_row(rows[b], 0),
              last = divisions[b].rank_of_row(rows[b], rows[b] - 1);
    found.push_back(first == last ? first : -1);
  }
  return found;
}

TEST(Divided, SmallBodiesAreWholeIfRanksHaveTheirShares) {
  using Owners = std::vector<int>;
  const std::vector<Index> equal(8, 500);
  on_ranks(2, [&](int) {
    EXPECT_EQ(owners(equal), (Owners{0, 0, 0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(owners({500, 500, 500, 500}), (Owners{0, 0, 1, 1})) << "half a share each";
    EXPECT_EQ(owners({500, 500, 500}), (Owners{-1, -1, -1})) << "two thirds of a share each";
    EXPECT_EQ(owners({10000}), Owners{-1});
    // The first rank would have 5000 rows of the large body, the second one 5000 and the small
    // body.
    EXPECT_EQ(owners({10000, 500}), (Owners{-1, 1})) << "1.048 shares";
    EXPECT_EQ(owners({10000, 600}), (Owners{-1, -1})) << "1.057 shares";
    EXPECT_EQ(owners({600, 10000, 50, 600}), (Owners{0, -1, 1, 1}));
    EXPECT_EQ(owners({10000, 600, 50}), (Owners{-1, -1, 1})) << "without the larger one";
  });
  on_ranks(3, [&](int) { EXPECT_EQ(owners(equal), Owners(8, -1)) << "1.125 shares on one"; });
  on_ranks(1, [&](int) { EXPECT_EQ(owners(equal), Owners(8, 0)); });
}

TEST(Divided, RowsOfAWholeBodyAreOfOneRank) {
  on_ranks(3, [&](int rank) {
    const Division division(1);
    const OwnItems rows = division.own_rows(70), items = division.own_items(5);
    EXPECT_EQ(rows.end - rows.begin, rank == 1 ? 70 : 0);
    EXPECT_EQ(items.end - items.begin, rank == 1 ? 5 : 0);
    EXPECT_EQ(division.first_row(70, 3), 70);
    EXPECT_EQ(division.rank_of_row(70, 69), 1);
  });
}

TEST(Divided, WhatEachHasIsNotBrought) {
  on_ranks(3, [&](int rank) {
    const Division division = Division::to_each();
    const OwnItems items = division.own_items(5);
    EXPECT_EQ(items.begin, 0);
    EXPECT_EQ(items.end, 5);
    EXPECT_EQ(division.rank_of_item(5, 4), rank);
    std::vector<Index> values(5, rank);
    division.complete_items(5, values.data(), sizeof values[0]);
    GatherTogether()({{Gathered(values.data(), division.items(5))}});
    for (Index k = 0; k < 5; ++k) EXPECT_EQ(at(values, k), rank);
  });
}

TEST(Divided, ItemsAreBroughtFromTheirRanks) {
  const std::vector<int> owner{2, 0, 0, 0, 1, 2, 1};
  on_ranks(3, [&](int rank) {
    SharedItems items;
    items.add(2);
    items.add(2, Division(0));
    items.add(3, evenly);
    items.add(1);
    std::vector<int> values(owner.size(), 7);
    for (std::size_t k = 0; k < owner.size(); ++k)
      if (owner[k] == rank) values[k] = 10 * rank;
    items.complete(values.data(), sizeof values[0]);
    for (std::size_t k = 0; k < owner.size(); ++k) EXPECT_EQ(values[k], 10 * owner[k]);
  });
}

/// Values of items, of rows, of rows in a list, of each part, and of chunks, in one exchange.
TEST(Gathered, ArraysAreCompletedTogether) {
  const std::vector<Index> listed{1, 14, 15, 33, 46, 47};
  on_ranks(3, [&](int rank) {
    const auto own_only = [rank](const Portions& portions, Index n) {
      std::vector<Index> values(static_cast<std::size_t>(n), -1);
      const ItemRange own = portions.own();
      for (Index k = own.begin; k < own.end; ++k) at(values, k) = 100 * rank + k;
      return values;
    };
    const Portions items = evenly.items(5), rows = evenly.rows(48),
                   list = evenly.listed(48, listed), whole = Division(1).listed(48, listed),
                   each = Division::to_each().items(2);
    std::vector<Index> of_items = own_only(items, 5), of_rows = own_only(rows, 48),
                       of_list = own_only(list, 6), of_whole = own_only(whole, 6),
                       of_each = own_only(each, 2);
    PartTally<int> parts(evenly), one_part(Division(2));
    *parts.mine() = rank;
    if (int* const mine = one_part.mine()) *mine = 5;
    EXPECT_EQ(one_part.mine() != nullptr, rank == 2);
    ChunkTally<Real> chunks(chunk_count(48), evenly);
    for (int c = 0; c < chunk_count(48); ++c)
      if (evenly.rank_of_item(chunk_count(48), c) == rank) chunks[c] = c;
    GatherTogether gather;
    for (int again = 0; again < 2; ++again)
      gather({{Gathered(of_items.data(), items), Gathered(of_rows.data(), rows),
               Gathered(of_list.data(), list), Gathered(of_whole.data(), whole),
               Gathered(of_each.data(), each), parts.gathered(), one_part.gathered(),
               chunks.gathered()}});
    for (Index k = 0; k < 5; ++k) EXPECT_EQ(at(of_items, k), 100 * evenly.rank_of_item(5, k) + k);
    for (Index k = 0; k < 48; ++k) EXPECT_EQ(at(of_rows, k), 100 * evenly.rank_of_row(48, k) + k);
    for (Index k = 0; k < 6; ++k) {
      EXPECT_EQ(at(of_list, k), 100 * evenly.rank_of_row(48, at(listed, k)) + k);
      EXPECT_EQ(at(of_whole, k), 100 + k);
    }
    for (Index k = 0; k < 2; ++k) EXPECT_EQ(at(of_each, k), 100 * rank + k);
    EXPECT_EQ(std::vector<int>(parts.begin(), parts.end()), (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(std::vector<int>(one_part.begin(), one_part.end()), std::vector<int>{5});
    EXPECT_EQ(chunks.sum(0.0), chunk_count(48) * (chunk_count(48) - 1) / 2);
  });
}

TEST(Gathered, AFailureOfOneRankIsThrownByAll) {
  on_ranks(3, [](int rank) {
    std::exception_ptr failure;
    if (rank == 1) failure = std::make_exception_ptr(SolveError("of rank 1"));
    EXPECT_THROW_WITH(GatherTogether()({}, failure), SolveError, "of rank 1");
    EXPECT_NO_THROW(GatherTogether()({}));
  });
}

TEST(Divided, AllValuesAreUsedInOrder) {
  std::vector<Index> used;
  evenly.for_all_in_order(
      50000, [](Index i) { return 2 * i; },
      [&](Index i, Index value) {
        EXPECT_EQ(value, 2 * i);
        used.push_back(i);
      });
  EXPECT_EQ(used.size(), 50000u);
  EXPECT_TRUE(std::is_sorted(used.begin(), used.end()));
}

TEST(Divided, WhatFailsOnOneRankFailsOnAllAsTheSame) {
  on_ranks(3, [](int rank) {
    const auto fail = [rank](const auto& error) {
      return [rank, error] {
        if (rank == 1) throw error;
      };
    };
    EXPECT_NO_THROW(on_each_rank([] {}));
    EXPECT_THROW_WITH(on_each_rank(fail(InputError("input"))), InputError, "input");
    EXPECT_THROW_WITH(on_each_rank(fail(FileError("file"))), FileError, "file");
    EXPECT_THROW_WITH(on_each_rank(fail(SolveError("singular"))), SolveError, "singular");
  });
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Compares each own row; rows of other ranks are empty.
template <int D>
void expect_rows_of(const CellRule<D>& some, const CellRule<D>& all, OwnItems cells) {
  ASSERT_EQ(some.groups(), all.groups());
  for (Index cell = 0; cell < all.groups(); ++cell) {
    const Offset begin = at(some.start, cell), size = at(some.start, cell + 1) - begin,
                 begin_of_all = at(all.start, cell);
    if (cell < cells.begin || cell >= cells.end) {
      EXPECT_EQ(size, 0);
      continue;
    }
    ASSERT_EQ(size, at(all.start, cell + 1) - begin_of_all);
    for (Offset e = 0; e < size; ++e)
      EXPECT_EQ(at(some.particle, begin + e), at(all.particle, begin_of_all + e));
    for (Offset k = 0; k < size * D; ++k)
      EXPECT_TRUE(same_bits(at(some.coefficient, begin * D + k),
                            at(all.coefficient, begin_of_all * D + k)));
  }
}

template <int D>
void expect_parts_of_rule(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  const CellRule<D> all = build_cell_rule(*body).rule;
  const Index n = body->size();
  for (const OwnItems cells : {OwnItems{0, n / 3}, OwnItems{n / 3, n / 3 + 1}, OwnItems{n / 3, n},
                               OwnItems{n, n}, OwnItems{0, n}})
    expect_rows_of<D>(build_cell_rule(*body, cells).rule, all, cells);
}

TEST(Divided, RowsOfSomeCellsHaveTheBitsOfTheWhole) {
  // There are more cells than one block contains.
  expect_parts_of_rule<2>(test::brick<2>({32, 32}, 0.3));
  expect_parts_of_rule<3>(test::brick<3>({10, 8, 8}, 0.3));
  expect_parts_of_rule<3>(test::potato<3>());
}

template <int D>
void expect_parts_of_point_rule(Index per_group) {
  const auto body = test::body_of<D>(test::potato<D>());
  const PointRule<D> all = build_gauss_rule(*body, 2, per_group);
  std::atomic<Index> points = 0;
  on_ranks(3, [&](int) {
    const PointRule<D> some = build_gauss_rule(*body, 2, per_group);
    ASSERT_EQ(some.rows.size(), all.rows.size());
    const OwnItems own = evenly.own_rows(all.groups());
    for (Index q = 0; q < all.rows.size(); ++q) {
      const Offset begin = at(some.rows.start, q), size = at(some.rows.start, q + 1) - begin,
                   begin_of_all = at(all.rows.start, q);
      if (q < own.begin * per_group || q >= own.end * per_group) {
        EXPECT_EQ(size, 0);
        continue;
      }
      ++points;
      ASSERT_EQ(size, at(all.rows.start, q + 1) - begin_of_all);
      EXPECT_EQ(at(some.point_owner, q), at(all.point_owner, q));
      for (Offset e = 0; e < size; ++e)
        EXPECT_EQ(at(some.rows.particle, begin + e), at(all.rows.particle, begin_of_all + e));
      for (Offset k = 0; k < size * D; ++k)
        EXPECT_TRUE(same_bits(at(some.rows.gradient, begin * D + k),
                              at(all.rows.gradient, begin_of_all * D + k)));
    }
  });
  EXPECT_EQ(points, all.rows.size());
}

TEST(Divided, RowsOfSomePointsHaveTheBitsOfTheWhole) {
  expect_parts_of_point_rule<2>(4);
  expect_parts_of_point_rule<2>(1);
  expect_parts_of_point_rule<3>(4);
}

}  // namespace
}  // namespace meniscus::test_divided
