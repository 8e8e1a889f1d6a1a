// SPDX-License-Identifier: BSD-3-Clause
// Operations on four lanes that use instructions of some processors, and plain C++ on others.
#include "numbers/dense.hpp"
#include "numbers/simd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meniscus::test_simd {
namespace {

const Lanes a{1, 2, 3, 4}, b{5, 6, 7, 8}, c{9, 10, 11, 12};

TEST(Simd, SquareRootsAreThoseOfTheLibrary) {
  const Lanes x{4, 2, 1e-300, 0}, root = sqrt(x);
  for (int lane = 0; lane < Lanes::width; ++lane) EXPECT_EQ(root[lane], std::sqrt(x[lane]));
}

TEST(Simd, AnyFindsASingleLane) {
  for (int lane = 0; lane < Lanes::width; ++lane) {
    Lanes x = Lanes::zero();
    x.set(lane, 1);
    EXPECT_TRUE(any(x.v > 0.5));
    EXPECT_FALSE(any(x.v > 1.5));
  }
}

TEST(Simd, VectorsByLane) {
  const auto vector = by_lane(a, b, c);
  for (int q = 0; q < Lanes::width; ++q) {
    EXPECT_EQ(at(vector, q)[0], a[q]);
    EXPECT_EQ(at(vector, q)[1], b[q]);
    EXPECT_EQ(at(vector, q)[2], c[q]);
    EXPECT_EQ(at(vector, q)[3], 0);
  }
}

TEST(Simd, LeastAndLargestByLane) {
  const Lanes x{1, 7, 2, 9}, y{3, 4, 8, 5}, least = min(x, y), largest = max(x, y);
  for (int lane = 0; lane < Lanes::width; ++lane) {
    EXPECT_EQ(least[lane], std::min(x[lane], y[lane]));
    EXPECT_EQ(largest[lane], std::max(x[lane], y[lane]));
  }
}

template <int D>
void expect_determinants() {
  std::array<std::array<Lanes, D>, D> four;
  std::array<Mat<D>, 4> each;
  for (int lane = 0; lane < Lanes::width; ++lane)
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        at(each, lane)(i, j) = std::sin(1 + lane + 4 * i + 11 * j) / 3;
        at(at(four, i), j).set(lane, at(each, lane)(i, j));
      }
  const Lanes det = determinant(four);
  for (int lane = 0; lane < Lanes::width; ++lane)
    EXPECT_EQ(det[lane], determinant<D>(at(each, lane)));
}
TEST(Simd, DeterminantsAreThoseOfEachAlone) {
  expect_determinants<2>();
  expect_determinants<3>();
}

}  // namespace
}  // namespace meniscus::test_simd
