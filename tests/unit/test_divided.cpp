// SPDX-License-Identifier: BSD-3-Clause
// Which rows a rank has, and that they are those of one process.
#include "meniscus/body/body.hpp"
#include "meniscus/core/divided.hpp"
#include "meniscus/core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "straight_grid.hpp"
#include "support.hpp"

namespace meniscus::test_divided {
namespace {

/// One of several ranks whose others say and bring nothing.
class OneOf final : public Ranks {
 public:
  static inline int number = 0, all = 1;
  int rank() const override { return number; }
  int size() const override { return all; }
};

/// Calls f as each of so many ranks.
template <class F>
void as_each_of(int size, F&& f) {
  register_ranks([]() -> std::unique_ptr<Ranks> { return std::make_unique<OneOf>(); });
  join_ranks();
  OneOf::all = size;
  for (OneOf::number = 0; OneOf::number < size; ++OneOf::number) f(OneOf::number);
  register_ranks([] { return std::make_unique<Ranks>(); });
  join_ranks();
}

TEST(Divided, EachRowIsOfOneRankInOrder) {
  for (const Index n : {0, 1, 5, 100, 40000})
    for (const int size : {1, 2, 3, 20}) {
      Index next = 0;
      as_each_of(size, [&](int rank) {
        const OwnItems own = own_rows(n);
        EXPECT_EQ(own.begin, next);
        for (Index row = own.begin; row < own.end; row += 7) EXPECT_EQ(rank_of_row(n, row), rank);
        next = own.end;
      });
      EXPECT_EQ(next, n);
    }
}

TEST(Divided, AllValuesAreUsedInOrder) {
  std::vector<Index> used;
  for_all_in_order(
      50000, [](Index i) { return 2 * i; },
      [&](Index i, Index value) {
        EXPECT_EQ(value, 2 * i);
        used.push_back(i);
      });
  EXPECT_EQ(used.size(), 50000u);
  EXPECT_TRUE(std::is_sorted(used.begin(), used.end()));
}

TEST(Divided, WhatFailsOnOneRankFailsOnAllAsTheSame) {
  as_each_of(2, [](int) {
    EXPECT_NO_THROW(on_each_rank([] {}));
    EXPECT_THROW(on_each_rank([] { throw InputError("input"); }), InputError);
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

/// Row by row; of the others there is nothing.
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
    const Offset exact = at(some.double_start, cell), exact_of_all = at(all.double_start, cell),
                 in_double = at(some.double_start, cell + 1) - exact;
    ASSERT_EQ(in_double, at(all.double_start, cell + 1) - exact_of_all);
    for (Offset e = 0; e < size; ++e)
      EXPECT_EQ(at(some.particle, begin + e), at(all.particle, begin_of_all + e));
    for (Offset k = 0; k < in_double * D; ++k)
      EXPECT_TRUE(same_bits(at(some.coefficient, exact * D + k),
                            at(all.coefficient, exact_of_all * D + k)));
    for (Offset k = 0; k < (size - in_double) * D; ++k)
      EXPECT_TRUE(same_bits(at(some.rounded, (begin - exact) * D + k),
                            at(all.rounded, (begin_of_all - exact_of_all) * D + k)));
  }
}

template <int D>
void expect_parts_of_rule(Geometry<D> geometry, RowPrecision precision) {
  const auto body = test::body_of<D>(std::move(geometry));
  const CellRule<D> all = build_cell_rule(*body, precision).rule;
  const Index n = body->size();
  for (const OwnItems cells : {OwnItems{0, n / 3}, OwnItems{n / 3, n / 3 + 1}, OwnItems{n / 3, n},
                               OwnItems{n, n}, OwnItems{0, n}})
    expect_rows_of<D>(build_cell_rule(*body, precision, cells).rule, all, cells);
}

TEST(Divided, RowsOfSomeCellsHaveTheBitsOfTheWhole) {
  // More cells than are treated together.
  expect_parts_of_rule<2>(test::brick<2>({32, 32}, 0.3), RowPrecision::full);
  expect_parts_of_rule<3>(test::brick<3>({10, 8, 8}, 0.3), RowPrecision::full);
  expect_parts_of_rule<3>(test::potato<3>(), RowPrecision::rounded);
}

template <int D>
void expect_parts_of_point_rule(Index per_group) {
  const auto body = test::body_of<D>(test::potato<D>());
  const PointRule<D> all = build_gauss_rule(*body, 2, per_group);
  Index points = 0;
  as_each_of(3, [&](int) {
    const PointRule<D> some = build_gauss_rule(*body, 2, per_group);
    ASSERT_EQ(some.rows.size(), all.rows.size());
    const OwnItems own = own_rows(all.groups());
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
