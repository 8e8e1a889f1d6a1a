// SPDX-License-Identifier: BSD-3-Clause
// The rows that a rank computes equal the rows of a run with one process.
#include "body/body.hpp"
#include "meniscus/error.hpp"
#include "parallel/divided.hpp"
#include "parallel/shared_items.hpp"
#include "physics/rank_reports.hpp"
#include "some_ranks.hpp"
#include "straight_grid.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace meniscus::test_divided {
namespace {

/// One rank of several. The data received from another rank contain its number in each byte.
class OneOf final : public OneOfRanks {
 public:
  void gather(void* values, std::span<const std::size_t> begin) override {
    for (std::size_t r = 0; r + 1 < begin.size(); ++r)
      if (static_cast<int>(r) != number)
        std::memset(static_cast<std::byte*>(values) + begin[r], static_cast<int>(r),
                    begin[r + 1] - begin[r]);
  }
};

TEST(Divided, EachRowIsOfOneRankInOrder) {
  for (const Index n : {0, 1, 5, 100, 40000})
    for (const int size : {1, 2, 3, 20}) {
      Index next = 0;
      as_each_of<OneOf>(size, [&](int rank) {
        const OwnItems own = evenly.own_rows(n);
        EXPECT_EQ(own.begin, next);
        for (Index row = own.begin; row < own.end; row += 7)
          EXPECT_EQ(evenly.rank_of_row(n, row), rank);
        next = own.end;
      });
      EXPECT_EQ(next, n);
    }
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
  as_each_of<OneOf>(2, [&](int) {
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
  as_each_of<OneOf>(3,
                    [&](int) { EXPECT_EQ(owners(equal), Owners(8, -1)) << "1.125 shares on one"; });
  as_each_of<OneOf>(1, [&](int) { EXPECT_EQ(owners(equal), Owners(8, 0)); });
}

TEST(Divided, RowsOfAWholeBodyAreOfOneRank) {
  as_each_of<OneOf>(3, [&](int rank) {
    const Division division(1);
    const OwnItems rows = division.own_rows(70), items = division.own_items(5);
    EXPECT_EQ(rows.end - rows.begin, rank == 1 ? 70 : 0);
    EXPECT_EQ(items.end - items.begin, rank == 1 ? 5 : 0);
    EXPECT_EQ(division.first_row(70, 3), 70);
    EXPECT_EQ(division.rank_of_row(70, 69), 1);
  });
}

TEST(Divided, WhatEachHasIsNotBrought) {
  as_each_of<OneOf>(3, [&](int rank) {
    const Division division = Division::to_each();
    const OwnItems items = division.own_items(5);
    EXPECT_EQ(items.begin, 0);
    EXPECT_EQ(items.end, 5);
    EXPECT_EQ(division.rank_of_item(5, 4), rank);
    std::vector<Index> values(5, rank);
    division.complete_items(5, values.data(), sizeof values[0]);
    divided_for(
        division, 5, [&](Index k) { at(values, k) += k; }, [](Index) { return 0; },
        [](Index, int) { ADD_FAILURE(); });
    for (Index k = 0; k < 5; ++k) EXPECT_EQ(at(values, k), rank + k);
  });
}

TEST(Divided, ItemsAreBroughtFromTheirRanks) {
  using Values = std::vector<std::uint16_t>;
  SharedItems items;
  items.add(2);
  items.add(2, Division(0));
  items.add(3, evenly);  // divided evenly; with one rank, all items are its own
  items.add(1);
  as_each_of<OneOf>(3, [&](int rank) {
    Values values(7, 7);
    items.complete(values.data(), sizeof values[0]);
    const std::vector<int> of{2, 0, 0, 0, 0, 0, 1};
    for (std::size_t k = 0; k < values.size(); ++k)
      EXPECT_EQ(values[k], of[k] == rank ? 7 : of[k] * 0x0101) << rank << " " << k;
    const std::vector<Offset> start{0, 0, 2, 5, 6};
    Values runs(6, 7);
    evenly.complete_runs(4, start, runs.data(), sizeof runs[0]);
    for (Index k = 0; k < 6; ++k) {
      const int owner = k < 2 ? 1 : 2;
      EXPECT_EQ(at(runs, k), owner == rank ? 7 : owner * 0x0101);
    }
    Values rows(48, 7);
    evenly.complete_rows(48, rows.data(), sizeof rows[0]);
    for (Index row = 0; row < 48; ++row) {
      const int owner = evenly.rank_of_row(48, row);
      EXPECT_EQ(at(rows, row), owner == rank ? 7 : owner * 0x0101);
    }
  });
}

/// Each rank computes its own rows of a list, even if these are none or all rows.
TEST(Divided, ListedRowsAreOfTheRanksThatHaveThem) {
  const std::vector<Index> listed{1, 14, 15, 33, 46, 47};
  as_each_of<OneOf>(3, [&](int rank) {
    std::vector<int> values(48, -1);
    Index done = 0;
    divided_for_rows(
        evenly, 48, listed,
        [&](Index row) {
          EXPECT_EQ(evenly.rank_of_row(48, row), rank);
          at(values, row) = row;
          ++done;
        },
        [&](Index row) { return at(values, row); },
        [&](Index row, int of_other) { at(values, row) = of_other; }, 1);
    for (Index row = 0; row < 48; ++row) {
      const int owner = evenly.rank_of_row(48, row),
                expected = owner == rank ? row : owner * 0x01010101;
      EXPECT_EQ(at(values, row),
                std::binary_search(listed.begin(), listed.end(), row) ? expected : -1);
    }
    EXPECT_EQ(done, (std::vector<Index>{2, 1, 3}[static_cast<std::size_t>(rank)]));
    const ItemRange whole = Division(1).own_listed(48, listed),
                    each = Division::to_each().own_listed(48, listed);
    EXPECT_EQ(whole.end - whole.begin, rank == 1 ? 6 : 0);
    EXPECT_EQ(each.end - each.begin, 6);
  });
}

TEST(RankReports, AreBroughtFromTheRankThatKnowsThem) {
  const Real strange = std::bit_cast<Real>(std::uint64_t{0x0101010101010101});
  as_each_of<OneOf>(2, [&](int rank) {
    std::vector<Report> reports(3);
    for (std::size_t k = 0; k < 3; ++k) reports[k].heat = reports[k].demand.longest = Real(k + 1);
    reports[1].known_by = 0;
    reports[1].failure = Failure{7, "of the first rank", true};
    reports[2].known_by = 1;
    RankReports().complete(reports);
    EXPECT_EQ(reports[0].heat, 1);
    EXPECT_EQ(reports[1].heat, rank == 0 ? 2 : 0);
    EXPECT_EQ(reports[1].failure.has_value(), rank == 0) << "the other says that it has none";
    if (reports[1].failure) {
      EXPECT_EQ(reports[1].failure->cause, "of the first rank");
      EXPECT_EQ(reports[1].failure->particle, 7);
      EXPECT_TRUE(reports[1].failure->of_step);
    }
    EXPECT_EQ(reports[2].heat, rank == 1 ? 3 : strange);
    EXPECT_EQ(reports[2].demand.longest, rank == 1 ? 3 : strange);
    for (const Report& report : reports) EXPECT_FALSE(report.known_by.has_value());
  });
}

TEST(RankReports, AnErrorIsThrownByAll) {
  as_each_of<OneOf>(2, [&](int rank) {
    std::vector<Report> reports(1);
    reports[0].known_by = 0;
    if (rank > 0) {  // the first rank throws nothing here
      EXPECT_NO_THROW(RankReports().complete(reports));
      return;
    }
    reports[0].error = "of the first rank";
    try {
      RankReports().complete(reports);
      ADD_FAILURE();
    } catch (const SolveError& e) {
      EXPECT_STREQ(e.what(), "of the first rank");
    }
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
  as_each_of<OneOf>(2, [](int) {
    EXPECT_NO_THROW(on_each_rank([] {}));
    EXPECT_THROW_WITH(on_each_rank([] { throw InputError("input"); }), InputError, "input");
    EXPECT_THROW(on_each_rank([] { throw FileError("file"); }), FileError);
    try {
      on_each_rank([] { throw SolveError("singular"); });
      ADD_FAILURE();
    } catch (const SolveError& error) {
      EXPECT_STREQ(error.what(), "singular");
    }
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
  Index points = 0;
  as_each_of<OneOf>(3, [&](int) {
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
