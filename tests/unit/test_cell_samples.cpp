// SPDX-License-Identifier: BSD-3-Clause
// Samples of nodal cells. With their corrections they integrate as exact rules do. They need no
// corrections where the cells around are equal and complete. They are few.
#include "body/grid/nodal_cells.hpp"
#include "kernel/monomials.hpp"
#include "meniscus/body/shapes.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <map>

namespace meniscus::test_cell_samples {
namespace {

template <int D, int degree>
using Values = std::array<Real, static_cast<std::size_t>(monomial_count(D, degree))>;

template <int D, int degree>
Values<D, degree> monomials(const Vec<D>& arm) {
  constexpr Monomials<D, degree> table;
  Values<D, degree> f;
  f[0] = 1;
  for (std::size_t k = 1; k < f.size(); ++k) f[k] = at(f, table.factor[k]) * arm[table.variable[k]];
  return f;
}

/// A brick of unit cells, without the cells whose x and y are both above its middle.
template <int D>
Grid<D> angle(int cells) {
  const Grid<D> whole = test::brick<D>(std::vector<Real>(D, cells)).grid;
  Grid<D> grid;
  std::map<Index, Index> number;
  for (const auto& cell : whole.cells) {
    Vec<D> middle = Vec<D>::Zero();
    for (const Vec<D>& X : whole.corner_points(cell)) middle += X / (1 << D);
    if (middle[0] > 0 && middle[1] > 0) continue;
    auto& kept = grid.cells.emplace_back();
    for (int a = 0; a < (1 << D); ++a) {
      const auto [entry, is_new] = number.try_emplace(at(cell, a), grid.node_count());
      if (is_new) grid.X.push_back(at(whole.X, at(cell, a)));
      at(kept, a) = entry->second;
    }
  }
  find_boundary(grid);
  return grid;
}

/// An exact integral and the sum over samples, which are to be equal.
struct Sums {
  Real integral = 0, scale = 0;
  Real sampled = 0;
};

/// Numbers of integrals that need corrections.
struct Inexact {
  int volumes = 0, facets = 0;
};

template <int D>
void check_volume(const NodalCells<D>& cells, Index node, const CellQuadrature<D>& q,
                  const CellSamples<D>& samples) {
  const Vec<D>& centre = cells.centroid(node);
  std::array<Sums, std::tuple_size_v<Values<D, 2>>> sums;
  for (std::size_t p = 0; p < q.volume_X.size(); ++p) {
    const auto f = monomials<D, 2>(q.volume_X[p] - centre);
    for (std::size_t k = 0; k < f.size(); ++k) {
      sums[k].integral += q.volume_w[p] * f[k];
      sums[k].scale += q.volume_w[p] * std::abs(f[k]);
    }
  }
  for (std::size_t p = 0; p < samples.volume_w.size(); ++p) {
    const auto f = monomials<D, 2>(samples.X[p] - centre);
    for (std::size_t k = 0; k < f.size(); ++k) sums[k].sampled += samples.volume_w[p] * f[k];
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (!samples.volume_exact) sums[k].sampled += samples.volume_missing[k];
    ASSERT_NEAR(sums[k].sampled, sums[k].integral, 1e-12 * sums[k].scale)
        << "node " << node << ", monomial " << k;
  }
}

/// Tests linear functions; also cubic functions where all facets are exact.
template <int D>
void check_facets(const NodalCells<D>& cells, Index node, const CellQuadrature<D>& q,
                  const CellSamples<D>& samples) {
  const Vec<D>& centre = cells.centroid(node);
  std::array<std::array<Sums, std::tuple_size_v<Values<D, 3>>>, D> sums;
  for (std::size_t p = 0; p < q.facet_X.size(); ++p) {
    const auto f = monomials<D, 3>(q.facet_X[p] - centre);
    for (int K = 0; K < D; ++K)
      for (std::size_t k = 0; k < f.size(); ++k) {
        at(sums, K)[k].integral += q.facet_dA[p][K] * f[k];
        at(sums, K)[k].scale += q.facet_dA[p].norm() * std::abs(f[k]);
      }
  }
  bool exact = true;
  for (const auto& facet : samples.facets) {
    exact = exact && facet.exact;
    for (std::size_t p = facet.begin; p < facet.end; ++p) {
      const auto& [number, dA] = samples.facet_points[p];
      const auto f = monomials<D, 3>(samples.X[number] - centre);
      for (int K = 0; K < D; ++K)
        for (std::size_t k = 0; k < f.size(); ++k) at(sums, K)[k].sampled += dA[K] * f[k];
    }
    if (facet.exact) continue;
    for (int K = 0; K < D; ++K) {
      const auto& missing = at(facet.missing, K);
      at(sums, K)[0].sampled += missing[0];
      for (int i = 0; i < D; ++i)
        at(at(sums, K), 1 + i).sampled +=
            at(missing, 1 + i) + missing[0] * (facet.centre - centre)[i];
    }
  }
  for (int K = 0; K < D; ++K)
    for (std::size_t k = 0; k < (exact ? sums[0].size() : 1 + D); ++k) {
      const Sums& sum = at(sums, K)[k];
      ASSERT_NEAR(sum.sampled, sum.integral, 1e-12 * sum.scale)
          << "node " << node << ", component " << K << ", monomial " << k;
    }
}

template <int D>
Inexact check(const Grid<D>& grid) {
  const NodalCells<D> cells(grid);
  const ParticleSet<D> particles(grid.X, 2.5, KernelFunction::cubic_spline);
  Inexact inexact;
  CellQuadrature<D> q;
  CellSamples<D> samples;
  for (Index node = 0; node < cells.size(); ++node) {
    cells.quadrature(node, q);
    cells.sample(node, std::numeric_limits<Index>::max(), particles, true, samples);
    check_volume(cells, node, q, samples);
    check_facets(cells, node, q, samples);
    inexact.volumes += !samples.volume_exact;
    for (const auto& facet : samples.facets) inexact.facets += !facet.exact;
  }
  return inexact;
}

template <int D>
void expect_brick() {
  const Inexact inexact = check<D>(test::brick<D>(std::vector<Real>(D, 4)).grid);
  EXPECT_EQ(inexact.volumes, 0);
  EXPECT_EQ(inexact.facets, 0);
}
TEST(CellSamples, MissNothingInABrick) {
  expect_brick<2>();
  expect_brick<3>();
}

/// Evaluations of all shape functions per nodal cell, averaged over the cells inside a body. Each
/// point counts once, and so does each correction of a volume or of a facet (shared by two cells).
Real evaluations(const Grid<3>& grid) {
  const NodalCells<3> cells(grid);
  const ParticleSet<3> particles(grid.X, 2.6, KernelFunction::cubic_spline);
  std::vector<bool> inside(grid.X.size(), true);
  for (const auto& facet : grid.facets)
    for (const Index node : facet.nodes) inside[static_cast<std::size_t>(node)] = false;
  std::size_t count = 0, evaluated = 0;
  CellSamples<3> samples;
  for (Index node = 0; node < cells.size(); ++node) {
    if (!inside[static_cast<std::size_t>(node)]) continue;
    ++count;
    cells.sample(node, 0, particles, true, samples);
    evaluated += samples.X.size() + (samples.volume_exact ? 0 : 1);
    for (const auto& facet : samples.facets) evaluated += facet.exact ? 0 : 1;
  }
  return static_cast<Real>(evaluated) / static_cast<Real>(count);
}

/// With separate points in each octant, uneven cells needed 116.
TEST(CellSamples, AreFewInUnevenCells) {
  const Real brick = evaluations(test::brick<3>({8, 8, 8}).grid),
             jittered = evaluations(test::brick<3>({8, 8, 8}, 0.3).grid),
             ball = evaluations(test::ball(5, 3).grid);
  std::printf("evaluations per inner cell: brick %.1f, jittered by 30 %% %.1f, ball %.1f\n", brick,
              jittered, ball);
  EXPECT_LT(brick, 30);
  EXPECT_LT(jittered, 54);
  EXPECT_LT(ball, 54);
}

/// Equal cells with a gap: the gap contains points of the rule. In 2D the error is so large that
/// octants have separate points, which need no corrections.
TEST(CellSamples, MissSomethingAtAReentrantEdge) {
  EXPECT_EQ(check<2>(angle<2>(4)).volumes, 0);
  const Inexact inexact = check<3>(angle<3>(4));
  EXPECT_EQ(inexact.volumes, 3);     // the inner nodes of the edge
  EXPECT_EQ(inexact.facets, 2 * 4);  // between these nodes, counted from both sides
}

/// Cell sizes differ by more than rounding, but by far less than a spacing.
TEST(CellSamples, MissSomethingInUnevenCells) {
  Grid<3> grid = test::brick<3>({4, 4, 4}).grid;
  for (Vec<3>& X : grid.X)
    if (X[0] > 0.5) X[0] *= 1 + 1e-9;
  const Inexact inexact = check<3>(grid);
  EXPECT_GT(inexact.volumes, 0);
  EXPECT_LT(inexact.volumes, grid.node_count());
}

TEST(CellSamples, OfCurvedAndDisorderedCells) {
  check<2>(test::disk(4, 2).grid);
  check<3>(test::ball(4, 2).grid);
  check<2>(test::brick<2>({5, 4}, 0.3).grid);
  check<3>(test::brick<3>({4, 3, 4}, 0.3).grid);
}

}  // namespace
}  // namespace meniscus::test_cell_samples
