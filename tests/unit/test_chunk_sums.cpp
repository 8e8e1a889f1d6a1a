// SPDX-License-Identifier: BSD-3-Clause
// Forces of rows are added up chunk by chunk. Bits do not depend on the number of threads, failed
// rows leave nothing behind, and chunks in spatial order touch few particles of other chunks.
#include "body/grid/ordering.hpp"
#include "parallel/chunk_sums.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace meniscus::test_chunk_sums {
namespace {

/// Rows that touch some particles with numbers near their own and some random particles.
struct Rows {
  std::vector<Offset> start{0};
  std::vector<Index> particle;
};

Rows scattered_rows(Index rows, Index particles) {
  std::mt19937 random(7);
  Rows r;
  for (Index row = 0; row < rows; ++row) {
    for (int k = 0; k < 5; ++k)
      r.particle.push_back(
          static_cast<Index>((row + random() % 20) % static_cast<unsigned>(particles)));
    if (row % 50 == 0)
      r.particle.push_back(static_cast<Index>(random() % static_cast<unsigned>(particles)));
    r.start.push_back(static_cast<Offset>(r.particle.size()));
  }
  return r;
}

/// A force of each entry that causes rounding in every sum.
NodalVector part(Offset entry) {
  const Real x = std::sin(static_cast<Real>(entry));
  return {x, 1 / (2 + x), 1e3 * x * x, 0.0};
}

void add_rows(const Rows& r, Index begin, Index end, NodalVector* force) {
  for (Offset e = at(r.start, begin); e < at(r.start, end); ++e)
    force[at(r.particle, e)] += part(e);
}

TEST(ChunkSums, AddsChunksInAscendingOrderWhateverTheThreads) {
  constexpr Index n = 3000;
  const Rows rows = scattered_rows(n, n);
  ChunkSums chunk_sums(rows.start, rows.particle, n, evenly);
  NodalVectors expected(n, NodalVector(1.0));
  for (int c = 0; c < chunk_count(n); ++c) {
    NodalVectors of_chunk(n, NodalVector::zero());
    add_rows(rows, chunk_begin(n, c), chunk_begin(n, c + 1), of_chunk.data());
    for (Index A = 0; A < n; ++A) at(expected, A) += at(of_chunk, A);
  }
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    NodalVectors force(n, NodalVector(1.0));
    chunk_sums.accumulate(force, [&](int, Index begin, Index end, NodalVector* sums) {
      add_rows(rows, begin, end, sums);
    });
    for (Index A = 0; A < n; ++A)
      for (int i = 0; i < 3; ++i) ASSERT_EQ(at(force, A)[i], at(expected, A)[i]) << threads;
  }
  omp_set_num_threads(before);
}

TEST(ChunkSums, KeepsNothingOfRowsThatFailed) {
  const Rows rows = scattered_rows(300, 300);
  ChunkSums chunk_sums(rows.start, rows.particle, 300, evenly);
  NodalVectors force(300, NodalVector::zero());
  const auto add = [&](bool fail) {
    chunk_sums.accumulate(force, [&](int, Index begin, Index end, NodalVector* sums) {
      add_rows(rows, begin, end, sums);
      if (fail) throw std::runtime_error("folded");
    });
  };
  EXPECT_THROW(add(true), std::runtime_error);
  add(false);
  NodalVectors expected(300, NodalVector::zero());
  add_rows(rows, 0, 300, expected.data());
  for (Index A = 0; A < 300; ++A) EXPECT_NEAR(at(force, A)[0], at(expected, A)[0], 1e-12);
}

TEST(ChunkSums, OfNoRowsLeaveForcesAlone) {
  ChunkSums chunk_sums(std::vector<Offset>{0}, {}, 2, evenly);
  NodalVectors force(2, NodalVector(3.0));
  chunk_sums.accumulate(force, [](int, Index, Index, NodalVector*) { FAIL(); });
  EXPECT_EQ(at(force, 1)[0], 3.0);
}

/// The points of a lattice, in spatial order.
std::vector<Vec<3>> lattice(int side) {
  std::vector<Vec<3>> points;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) points.push_back(Vec<3>(x, y, z));
  std::vector<Vec<3>> ordered;
  for (const Index A : spatial_order<3>(points)) ordered.push_back(at(points, A));
  return ordered;
}

/// Rows touch all particles within two layers of their own. A chunk of 8 x 16 x 16 particles then
/// touches its box grown by two layers, within the cube.
TEST(ChunkSums, ChunksInSpatialOrderTouchLittleOfOthers) {
  constexpr int side = 32, reach = 2;
  const std::vector<Vec<3>> points = lattice(side);
  const auto n = static_cast<Index>(points.size());
  std::vector<Index> number(points.size());
  const auto place = [](int x, int y, int z) { return (x * side + y) * side + z; };
  for (Index A = 0; A < n; ++A) {
    const Vec<3>& X = at(points, A);
    at(number, place(int(X[0]), int(X[1]), int(X[2]))) = A;
  }
  Rows rows;
  std::size_t expected = 0;
  for (int c = 0; c < chunk_count(n); ++c) {
    Vec<3> low = at(points, chunk_begin(n, c)), high = low;
    for (Index A = chunk_begin(n, c); A < chunk_begin(n, c + 1); ++A) {
      const Vec<3>& X = at(points, A);
      low = low.cwiseMin(X);
      high = high.cwiseMax(X);
      const auto from = [&](int k) { return std::max(int(X[k]) - reach, 0); };
      const auto to = [&](int k) { return std::min(int(X[k]) + reach, side - 1); };
      for (int x = from(0); x <= to(0); ++x)
        for (int y = from(1); y <= to(1); ++y)
          for (int z = from(2); z <= to(2); ++z)
            rows.particle.push_back(at(number, place(x, y, z)));
      rows.start.push_back(static_cast<Offset>(rows.particle.size()));
    }
    EXPECT_EQ((high - low + Vec<3>::Ones()).prod(), 2048);
    const Vec<3> layers = (high.array() + reach).min(side - 1) - (low.array() - reach).max(0) + 1;
    expected += static_cast<std::size_t>(layers.prod());
  }
  EXPECT_EQ(ChunkSums(rows.start, rows.particle, n, evenly).sums(), expected);
  EXPECT_LT(expected, 2.1 * side * side * side);
}

}  // namespace
}  // namespace meniscus::test_chunk_sums
