// SPDX-License-Identifier: BSD-3-Clause
// The search tree against brute force.
#include "kernel/neighbor_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace meniscus::test_neighbor_search {
namespace {

template <int D>
std::vector<Vec<D>> random_cloud(int n, std::mt19937_64& generator) {
  std::uniform_real_distribution<Real> uniform(-1, 1);
  std::vector<Vec<D>> points(static_cast<std::size_t>(n));
  for (auto& x : points)
    for (int i = 0; i < D; ++i) x[i] = uniform(generator);
  return points;
}

template <int D>
std::vector<Index> brute_force(const std::vector<Vec<D>>& points, const Vec<D>& x, Real radius) {
  std::vector<Index> found;
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((points[i] - x).norm() <= radius) found.push_back(static_cast<Index>(i));
  return found;
}

template <class T>
class NeighborSearchTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(NeighborSearchTest, Dimensions);

TYPED_TEST(NeighborSearchTest, FindsWhatBruteForceFinds) {
  constexpr int D = TypeParam::value;
  std::mt19937_64 generator(5);
  auto points = random_cloud<D>(400, generator);
  for (std::size_t i = 0; i < 60; ++i) points.push_back(points[i]);  // duplicates
  const NeighborSearch<D> search(points);
  std::uniform_real_distribution<Real> size(0, 1.2);
  std::vector<Index> found{1, 2, 3};
  for (const Vec<D>& x : random_cloud<D>(60, generator)) {
    const Real radius = size(generator);
    search.within(x, radius, found);
    EXPECT_EQ(found, brute_force<D>(points, x, radius));
  }
}

TYPED_TEST(NeighborSearchTest, CountsPointsExactlyOnTheSphere) {
  constexpr int D = TypeParam::value;
  std::mt19937_64 generator(6);
  const auto points = random_cloud<D>(200, generator);
  const NeighborSearch<D> search(points);
  std::vector<Index> found;
  for (std::size_t i = 0; i < 20; ++i)
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Real radius = (points[j] - points[i]).norm();
      search.within(points[i], radius, found);
      ASSERT_EQ(found, brute_force<D>(points, points[i], radius * (1 + 1e-14)));
      ASSERT_TRUE(std::binary_search(found.begin(), found.end(), static_cast<Index>(j)));
    }
}

TYPED_TEST(NeighborSearchTest, RadiusZeroFindsThePointItself) {
  constexpr int D = TypeParam::value;
  const std::vector<Vec<D>> points{Vec<D>::Constant(1), Vec<D>::Constant(2), Vec<D>::Constant(1)};
  const NeighborSearch<D> search(points);
  std::vector<Index> found;
  search.within(points[0], 0, found);
  EXPECT_EQ(found, (std::vector<Index>{0, 2}));
  search.within(points[0], -5, found);
  EXPECT_TRUE(found.empty());
}

TYPED_TEST(NeighborSearchTest, OrdersDistances) {
  constexpr int D = TypeParam::value;
  std::mt19937_64 generator(7);
  const auto points = random_cloud<D>(150, generator);
  const NeighborSearch<D> search(points);
  for (const Vec<D>& x : random_cloud<D>(20, generator)) {
    std::vector<Real> distance;
    for (const auto& p : points) distance.push_back((p - x).norm());
    std::sort(distance.begin(), distance.end());
    for (const int k : {1, 2, 21, 150})
      EXPECT_NEAR(search.distance_of_nearest(x, k), at(distance, k - 1), 1e-15);
    EXPECT_NEAR(search.distance_of_nearest(x, 1000), distance.back(), 1e-15);
  }
  EXPECT_EQ(search.distance_of_nearest(points[3], 1), 0);
}

TYPED_TEST(NeighborSearchTest, FindsNothingNearAPlaceThatIsNotANumber) {
  constexpr int D = TypeParam::value;
  std::mt19937_64 generator(11);
  const NeighborSearch<D> search(random_cloud<D>(50, generator));
  const Vec<D> nowhere = Vec<D>::Constant(std::nan(""));
  EXPECT_EQ(search.distance_of_nearest(nowhere, 1), unbounded);
  std::vector<Index> found;
  search.within(nowhere, unbounded, found);
  EXPECT_TRUE(found.empty());
}

TYPED_TEST(NeighborSearchTest, FollowsAMovedCloud) {
  constexpr int D = TypeParam::value;
  std::mt19937_64 generator(8);
  NeighborSearch<D> search(random_cloud<D>(100, generator));
  const auto moved = random_cloud<D>(100, generator);
  search.rebuild(moved);
  std::vector<Index> found;
  for (const Vec<D>& x : moved) {
    search.within(x, 0.4, found);
    EXPECT_EQ(found, brute_force<D>(moved, x, 0.4));
  }
}

/// A lattice in blocks of `per_block` consecutive points.
template <int D>
std::vector<Vec<D>> lattice_of_blocks(int blocks, int per_side) {
  std::vector<Vec<D>> points;
  const int per_block = D == 3 ? per_side * per_side * per_side : per_side * per_side;
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < per_block; ++k) {
      Vec<D> x = Vec<D>::Constant(0.1 * (k % per_side));
      x[0] = 0.1 * (b * per_side + k % per_side);
      x[1] = 0.1 * (k / per_side % per_side);
      if constexpr (D == 3) x[2] = 0.1 * (k / (per_side * per_side));
      points.push_back(x);
    }
  return points;
}

TYPED_TEST(NeighborSearchTest, FindsTheSameInManyTreesAsInOne) {
  constexpr int D = TypeParam::value;
  std::mt19937_64 generator(9);
  // An unordered cloud with duplicate points, whose last tree has few points.
  std::vector<Vec<D>> points = random_cloud<D>(400, generator);
  for (std::size_t i = 0; i < 60; ++i) points.push_back(points[i]);
  const NeighborSearch<D> one(points);
  for (const Index per_tree : {1, 7, 64, 459, 460, 1000}) {
    const auto many = NeighborSearch<D>::in_order(points, per_tree);
    std::uniform_real_distribution<Real> size(0, 1.2);
    std::vector<Index> found, expected;
    for (const Vec<D>& x : random_cloud<D>(60, generator)) {
      const Real radius = size(generator);
      many.within(x, radius, found);
      one.within(x, radius, expected);
      EXPECT_EQ(found, expected);
      for (const int k : {1, 3, 21, 460, 1000})
        EXPECT_EQ(many.distance_of_nearest(x, k), one.distance_of_nearest(x, k));
      EXPECT_EQ(many.distance_of_nearest(3 * x, 5), one.distance_of_nearest(3 * x, 5));
    }
    for (std::size_t i = 0; i < 20; ++i)  // exactly on the sphere
      for (const Vec<D>& y : points) {
        const Real radius = (y - points[i]).norm();
        many.within(points[i], radius, found);
        one.within(points[i], radius, expected);
        ASSERT_EQ(found, expected);
      }
    EXPECT_EQ(many.trees(), (460 + per_tree - 1) / per_tree);
  }
}

TYPED_TEST(NeighborSearchTest, HasTreesWhereItWasAsked) {
  constexpr int D = TypeParam::value;
  constexpr int blocks = 8, per_side = 6;
  const auto points = lattice_of_blocks<D>(blocks, per_side);
  const auto per_block = static_cast<Index>(points.size() / blocks);
  const auto search = NeighborSearch<D>::in_order(points, per_block);
  EXPECT_EQ(search.trees(), 0);
  std::vector<Index> found;
  search.within(points[static_cast<std::size_t>(per_block / 2)], 0.05, found);
  EXPECT_EQ(search.trees(), 1);
  search.distance_of_nearest(points.back(), 2);
  EXPECT_EQ(search.trees(), 2);
  search.within(points.back(), 0.7, found);  // reaches the previous block
  EXPECT_EQ(search.trees(), 3);
  search.within(Vec<D>::Constant(1e3), 1, found);
  EXPECT_EQ(search.trees(), 3);
}

}  // namespace
}  // namespace meniscus::test_neighbor_search
