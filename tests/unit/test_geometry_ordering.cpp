// SPDX-License-Identifier: BSD-3-Clause
// Spatial order and renumbering.
#include "body/grid/ordering.hpp"
#include "body/surface/surface_points.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"
#include "parallel/parallel.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace meniscus::test_geometry_ordering {
namespace {

Ellipsoid long_ellipsoid() {
  Ellipsoid body;
  body.semi_axes = {1, 3, 1};
  body.core = 6;
  body.layers = 3;
  return body;
}

/// A long body is cut across its length.
TEST(Ordering, HalvesAreCutAcrossTheLongestEdge) {
  Geometry<3> body = long_ellipsoid().geometry();
  const std::vector<Vec<3>> before = body.grid.X;
  const std::vector<Index> order = order_spatially(body);
  const Index n = body.grid.node_count(), middle = chunk_begin(n, chunk_count(n) / 2);
  Real highest = -3, lowest = 3;
  for (Index i = 0; i < n; ++i) {
    const Vec<3>& X = at(body.grid.X, i);
    EXPECT_EQ(X, at(before, at(order, i)));
    if (i < middle)
      highest = std::max(highest, X[1]);
    else
      lowest = std::min(lowest, X[1]);
  }
  EXPECT_LE(highest, lowest + 1e-5);
}

/// Layers with rounding errors in their coordinates have the same order as a perfect lattice.
TEST(Ordering, RoundingOfCoordinatesChangesNothing) {
  std::vector<Vec<2>> points, rounded;
  for (int k = 0; k < 35 * 35; ++k) {
    points.push_back(Vec<2>(k / 35, k % 35) / 34);
    rounded.push_back(points.back() + 1e-13 * Vec<2>(std::sin(k), std::cos(3 * k)));
  }
  EXPECT_EQ(spatial_order<2>(points), spatial_order<2>(rounded));
}

/// Mean distance of particle numbers within a cell, a measure of the distance of neighbours in
/// memory.
template <int D>
Real mean_spread(const Grid<D>& grid) {
  Real sum = 0;
  for (const auto& cell : grid.cells) {
    const auto [low, high] = std::minmax_element(cell.begin(), cell.end());
    sum += *high - *low;
  }
  return sum / grid.cell_count();
}

TEST(Ordering, BringsNeighboursTogether) {
  Geometry<3> body = Ball{}.geometry();
  const Real before = mean_spread(body.grid);
  order_spatially(body);
  EXPECT_LT(mean_spread(body.grid), 0.7 * before);
}

TEST(Ordering, RenumberedBodyIsTheSameBody) {
  Geometry<3> body = long_ellipsoid().geometry();
  const Geometry<3> before = body;
  order_spatially(body);
  EXPECT_NEAR(volume(body.grid), volume(before.grid), 1e-13);
  EXPECT_NO_THROW(check_jacobians(body.grid, "Renumbering"));
  Grid<3> again = body.grid;
  find_boundary(again);
  ASSERT_EQ(again.facets.size(), body.grid.facets.size());
  for (std::size_t f = 0; f < again.facets.size(); ++f) {
    EXPECT_EQ(again.facets[f].nodes, body.grid.facets[f].nodes);
    EXPECT_EQ(again.facets[f].cell, body.grid.facets[f].cell);
    EXPECT_EQ(again.facets[f].side, body.grid.facets[f].side);
  }
  const auto sum = [](const SurfacePoints<3>& points) {
    Mat<3> total = Mat<3>::Zero();
    for (Index q = 0; q < points.size(); ++q) total += at(points.area, q) * at(points.grad_N, q);
    return total;
  };
  EXPECT_LT((sum(surface_points(body, 3)) - sum(surface_points(before, 3))).norm(), 1e-12);
}

TEST(Ordering, MarkTellsOrdersApart) {
  const std::vector<Vec<3>> points = long_ellipsoid().geometry().grid.X;
  const Vec<3> mark = mark_of_order<3>(points);
  std::vector<Vec<3>> changed = points;
  for (std::size_t A = 0; A < points.size(); ++A)
    changed[A] *= 1 + 1e-15 * std::sin(static_cast<Real>(A));
  EXPECT_LT((mark_of_order<3>(changed) - mark).norm(), 1e-11);
  for (std::size_t A = 0; A + 1 < points.size(); ++A) {
    changed = points;
    std::swap(changed[A], changed[A + 1]);
    EXPECT_GT((mark_of_order<3>(changed) - mark).norm(), 1e-3 * (points[A] - points[A + 1]).norm());
  }
}

TEST(Ordering, EqualPlacesKeepTheirOrder) {
  const std::vector<Vec<2>> points(5, Vec<2>(1, 1));
  EXPECT_EQ(spatial_order<2>(points), (std::vector<Index>{0, 1, 2, 3, 4}));
}

TEST(Ordering, RefusesWhatIsNoPermutation) {
  Geometry<2> disk = Disk{}.geometry();
  std::vector<Index> order(disk.grid.X.size());
  std::iota(order.begin(), order.end(), 0);
  order[1] = 0;
  EXPECT_THROW_WITH(renumber<2>(disk.grid, order), InputError, "not a permutation");
  order.pop_back();
  EXPECT_THROW_WITH(renumber<2>(disk.grid, order), InputError, "not a permutation");
}

}  // namespace
}  // namespace meniscus::test_geometry_ordering
