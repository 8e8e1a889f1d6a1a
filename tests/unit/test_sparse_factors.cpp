// SPDX-License-Identifier: BSD-3-Clause
// Sparse factors, and the order of grid nodes that keeps them small.
#include "solve/linear/nested_dissection.hpp"
#include "solve/linear/sparse_factors.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

namespace meniscus {
namespace {

/// A grid of unit cells.
template <int D>
Grid<D> lattice(const std::array<Index, D>& cells) {
  Grid<D> grid;
  const std::array<Index, D> nodes = [&] {
    auto n = cells;
    for (Index& k : n) ++k;
    return n;
  }();
  const Index all = std::accumulate(nodes.begin(), nodes.end(), 1, std::multiplies());
  for (Index a = 0; a < all; ++a) {
    Vec<D> X;
    typename Grid<D>::Cell cell;
    cell.fill(a);
    bool inside = true;
    for (Index k = 0, rest = a, stride = 1; k < D; ++k) {
      const Index i = rest % at(nodes, k);
      X[k] = i;
      inside &= i < at(cells, k);
      for (int corner = 0; corner < Grid<D>::corners; ++corner)
        if ((corner >> k) & 1) at(cell, corner) += stride;
      rest /= at(nodes, k);
      stride *= at(nodes, k);
    }
    grid.X.push_back(X);
    if (inside) grid.cells.push_back(cell);
  }
  return grid;
}

/// A matrix of springs: nodes of a cell are connected by springs of different stiffness, and all
/// nodes to the ground by weak springs.
template <int D>
std::vector<MatrixEntry> springs(const Grid<D>& grid) {
  std::vector<MatrixEntry> entries;
  for (const auto& cell : grid.cells)
    for (const Index a : cell)
      for (const Index b : cell)
        if (a < b) {
          const Real k = 1 + 0.3 * std::sin(a + 2.0 * b);
          entries.insert(entries.end(), {{a, a, k}, {b, b, k}, {a, b, -k}, {b, a, -k}});
        }
  for (Index a = 0; a < static_cast<Index>(grid.X.size()); ++a) entries.push_back({a, a, 1e-3});
  return entries;
}

template <int D>
void expect_order_of(const Grid<D>& grid) {
  const auto n = static_cast<Index>(grid.X.size());
  const std::vector<Index> order = nested_dissection(grid);
  std::vector<Index> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Index> all(grid.X.size());
  std::iota(all.begin(), all.end(), 0);
  ASSERT_EQ(sorted, all);

  const std::vector<MatrixEntry> entries = springs(grid);
  const SparseCholesky cut(n, entries, order), least(n, entries);
  std::vector<Real> x(grid.X.size()), b(grid.X.size(), 0.0);
  for (Index a = 0; a < n; ++a) at(x, a) = std::cos(3.0 * a);
  for (const MatrixEntry& e : entries) at(b, e.row) += e.value * at(x, e.column);
  for (const SparseCholesky* factors : {&cut, &least}) {
    std::vector<Real> solved = b;
    factors->solve(solved);
    NodalVectors all_components(b.size());
    for (Index a = 0; a < n; ++a) at(all_components, a) = Lanes(at(b, a), -2 * at(b, a), 0, 0);
    factors->solve(std::span(all_components));
    for (Index a = 0; a < n; ++a) {
      EXPECT_NEAR(at(all_components, a)[0], at(solved, a), 1e-12 * n);
      EXPECT_NEAR(at(all_components, a)[1], -2 * at(solved, a), 1e-12 * n);
      EXPECT_EQ(at(all_components, a)[2], 0);
    }
    for (Index a = 0; a < n; ++a) EXPECT_NEAR(at(solved, a), at(x, a), 1e-9);
  }

  EXPECT_LT(static_cast<Real>(cut.bytes()) / static_cast<Real>(least.bytes()), D == 2 ? 1.0 : 0.75);
}

TEST(NestedDissection, KeepsFactorsOfGridsSmall) {
  expect_order_of(lattice<2>({40, 40}));
  expect_order_of(lattice<3>({14, 14, 14}));
}

TEST(NestedDissection, HalvesHaveNoCellInCommon) {
  const Grid<3> grid = lattice<3>({24, 4, 4});
  const std::vector<Index> order = nested_dissection(grid);
  // The last nodes form a plane across the bar.
  const std::set<Index> between(order.end() - 25, order.end());
  Real place = 0;
  for (const Index a : between) place += at(grid.X, a)[0] / 25;
  for (const Index a : between) EXPECT_NEAR(at(grid.X, a)[0], place, 1e-12);
  EXPECT_NEAR(place, 12, 1);
}

TEST(SparseCholesky, NamesTheRowThatDependsOnOthersInAnyOrder) {
  // Row 2 is the sum of rows 0 and 1.
  const Real A[4][4] = {{2, 1, 3, 0}, {1, 3, 4, 0}, {3, 4, 7, 0}, {0, 0, 0, 5}};
  std::vector<MatrixEntry> entries;
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 4; ++j) entries.push_back({i, j, A[i][j]});
  for (const std::vector<Index>& order : {std::vector<Index>{0, 1, 2, 3}, {3, 0, 1, 2}}) {
    const auto least = SparseCholesky(4, entries, order).smallest_pivot();
    EXPECT_LT(std::abs(least.value), 1e-14);
    EXPECT_EQ(least.row, 2);
  }
}

TEST(SparseCholesky, SolvesPartsThatHaveNothingToDoWithEachOther) {
  std::vector<MatrixEntry> entries = springs(lattice<3>({3, 3, 3}));
  for (const MatrixEntry& e : springs(lattice<2>({5, 1})))
    entries.push_back({e.row + 64, e.column + 64, e.value});
  entries.push_back({76, 76, 3});
  for (const bool backwards : {false, true}) {
    std::vector<Index> order(77);
    std::iota(order.begin(), order.end(), 0);
    if (backwards) std::reverse(order.begin(), order.end());
    std::vector<Real> x(77), b(77, 0.0);
    for (Index a = 0; a < 77; ++a) at(x, a) = std::cos(3.0 * a);
    for (const MatrixEntry& e : entries) at(b, e.row) += e.value * at(x, e.column);
    SparseCholesky(77, entries, order).solve(b);
    for (Index a = 0; a < 77; ++a) EXPECT_NEAR(at(b, a), at(x, a), 1e-10);
  }
}

TEST(SparseCholesky, ShowsThatAMatrixIsNotPositive) {
  std::vector<MatrixEntry> entries = springs(lattice<3>({4, 3, 3}));
  EXPECT_GT(SparseCholesky(80, entries).smallest_pivot().value, 1e-5);
  entries.insert(entries.end(), {{17, 18, 90}, {18, 17, 90}});
  EXPECT_LT(SparseCholesky(80, entries).smallest_pivot().value, -0.1);
}

TEST(SparseCholesky, HasTheSameBitsForAnyNumberOfThreads) {
  const Grid<3> grid = lattice<3>({20, 15, 6});
  const auto n = static_cast<Index>(grid.X.size());
  const auto solution = [&](int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    std::vector<Real> x(grid.X.size());
    for (Index a = 0; a < n; ++a) at(x, a) = std::cos(3.0 * a);
    const SparseCholesky factors(n, springs(grid), nested_dissection(grid));
    EXPECT_GT(factors.bytes(), 1'000'000U) << "too few entries for threads";
    factors.solve(x);
    omp_set_num_threads(before);
    return x;
  };
  const std::vector<Real> one = solution(1);
  EXPECT_EQ(one, solution(2));
  EXPECT_EQ(one, solution(3));
}

}  // namespace
}  // namespace meniscus
