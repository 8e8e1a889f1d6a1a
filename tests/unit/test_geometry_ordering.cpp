// SPDX-License-Identifier: BSD-3-Clause
// Spatial order and renumbering.
#include "meniscus/body/ordering.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/body/surface_points.hpp"
#include "meniscus/core/error.hpp"

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

TEST(Ordering, SlabsFollowTheLongestAxis) {
  Geometry<3> body = long_ellipsoid().geometry();
  const std::vector<Vec<3>> before = body.grid.X;
  const std::vector<Index> order = order_spatially(body);
  const Real h = std::cbrt(volume(body.grid) / body.grid.node_count());
  for (Index i = 0; i < body.grid.node_count(); ++i) {
    EXPECT_EQ(at(body.grid.X, i), at(before, at(order, i)));
    const Index previous = std::max(i - 1, 0);
    EXPECT_GT(at(body.grid.X, i)[1], at(body.grid.X, previous)[1] - h);
  }
}

/// Mean distance of numbers within a cell: what decides the width of the force windows.
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

TEST(Ordering, EqualPlacesKeepTheirOrder) {
  const std::vector<Vec<2>> points(5, Vec<2>(1, 1));
  EXPECT_EQ(spatial_order<2>(points, 0.1), (std::vector<Index>{0, 1, 2, 3, 4}));
}

TEST(Ordering, RefusesWhatIsNoPermutation) {
  Geometry<2> disk = Disk{}.geometry();
  std::vector<Index> order(disk.grid.X.size());
  std::iota(order.begin(), order.end(), 0);
  order[1] = 0;
  EXPECT_THROW(renumber<2>(disk.grid, order), InputError);
  order.pop_back();
  EXPECT_THROW(renumber<2>(disk.grid, order), InputError);
}

}  // namespace
}  // namespace meniscus::test_geometry_ordering
