// SPDX-License-Identifier: BSD-3-Clause
// Curved boundary cells: enclosed volume and its order, rims, conformity, straight bodies, jitter.
#include "body/grid/nodal_cells.hpp"
#include "body/grid/ordering.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"
#include "straight_grid.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

namespace meniscus::test_geometry_curved {
namespace {

using std::numbers::pi;

/// Observed order of the error of the volume from cells of size 1/5 and 1/10 of the core.
template <int D>
Real order_of(const std::function<Grid<D>(int core, int layers)>& grid, Real exact) {
  const Real coarse = volume(grid(5, 3)) - exact, fine = volume(grid(10, 6)) - exact;
  return std::log2(coarse / fine);
}

template <int D>
void expect_orders(const std::function<Grid<D>(int core, int layers)>& grid, Real exact) {
  const auto straight = [&](int core, int layers) { return test::straight(grid(core, layers)); };
  EXPECT_NEAR(order_of<D>(grid, exact), 4, 0.1);
  EXPECT_NEAR(order_of<D>(straight, exact), 2, 0.1);
}

template <class Shape>
auto shape_of(int core, int layers) {
  Shape shape;
  shape.core = core;
  if constexpr (requires { shape.rings; })
    shape.rings = layers;
  else
    shape.layers = layers;
  return shape;
}

TEST(CurvedCells, VolumeConvergesWithFourthOrder) {
  expect_orders<3>([](int c, int l) { return shape_of<Ball>(c, l).geometry().grid; }, 4 * pi / 3);
  expect_orders<3>([](int c, int l) { return shape_of<Cylinder>(c, l).geometry().grid; }, pi);
  expect_orders<2>([](int c, int l) { return shape_of<Disk>(c, l).geometry().grid; }, pi);
  const auto ellipse = [](int c, int l) {
    auto shape = shape_of<Ellipse>(c, l);
    shape.semi_axes = {2, 0.5};
    return shape.geometry().grid;
  };
  expect_orders<2>(ellipse, pi);
  const auto twisted = [](int c, int l) {
    return apply_map(twist_ellipsoid(), shape_of<Ball>(c, l).geometry()).grid;
  };
  expect_orders<3>(twisted, 2 * pi);
}

TEST(CurvedCells, BiconcaveVolume) {
  // The volume is pi times the integral of sqrt(u) thickness(r^2 = 1 - u) over 0 < u < 1.
  const Real exact = pi * (0.207161 * 2 / 3 + 2.002558 * 4 / 15 - 1.122762 * 16 / 105);
  const auto error = [exact](int core, bool curved) {
    const Grid<3> grid = apply_map(biconcave(), shape_of<Ball>(core, core / 2).geometry()).grid;
    return std::abs(volume(curved ? grid : test::straight(grid)) / exact - 1);
  };
  // Errors of convex and concave parts cancel: the order is not clean.
  EXPECT_LT(error(8, true), 2e-7);
  EXPECT_LT(error(16, true), 5e-9);
  EXPECT_NEAR(std::log2(error(8, false) / error(16, false)), 2, 0.1);
}

/// Calls f(cell, mode, middle of the edge or side) for all possible modes of cells.
template <int D, class F>
void for_middles(const Grid<D>& grid, F&& f) {
  for (Index e = 0; e < grid.cell_count(); ++e)
    for (const BulgeMode mode : Bulge<D>::modes) {
      Vec<D> xi = Vec<D>::Zero();
      for (int k = 0; k < D; ++k)
        if (!((mode.along >> k) & 1)) xi[k] = (mode.upper >> k) & 1 ? 1 : -1;
      f(e, mode, cell_point(grid.corner_points(at(grid.cells, e)), grid.bulge(e), xi).X);
    }
}

TEST(CurvedCells, RimOfACylinderIsACircle) {
  auto shape = shape_of<Cylinder>(4, 2);
  const Grid<3> grid = shape.geometry().grid;
  const auto on_rim = [&](Index i) {
    const Vec<3>& X = at(grid.X, i);
    return std::abs(X.head<2>().norm() - 1) < 1e-12 && std::abs(std::abs(X[2]) - 0.5) < 1e-12;
  };
  int rims = 0, mantles = 0;
  for_middles(grid, [&](Index e, BulgeMode mode, const Vec<3>& middle) {
    const auto& cell = at(grid.cells, e);
    const Index a = at(cell, mode.upper), b = at(cell, mode.upper | mode.along);
    if (!on_rim(a) || !on_rim(b)) return;
    if (std::abs(at(grid.X, a)[2] - at(grid.X, b)[2]) > 0.1) return;
    EXPECT_NEAR(middle.head<2>().norm(), 1, 1e-15);
    EXPECT_NEAR(std::abs(middle[2]), 0.5, 1e-15);
    ++rims;
  });
  EXPECT_EQ(rims, 2 * 16);
  for (const auto& facet : grid.facets) {
    if (facet.patch != 0) continue;
    for_middles(grid, [&](Index e, BulgeMode mode, const Vec<3>& middle) {
      const unsigned across = 1u << (facet.side / 2);
      if (e != facet.cell || mode.along != (7u & ~across)) return;
      if ((mode.upper != 0) != (facet.side % 2 == 1)) return;
      EXPECT_NEAR(middle.head<2>().norm(), 1, 1e-15);
      ++mantles;
    });
  }
  EXPECT_EQ(mantles, 16 * 3);
}

TEST(CurvedCells, MiddlesLieOnTheEllipsoid) {
  const Grid<3> grid = apply_map(twist_ellipsoid(), shape_of<Ball>(4, 2).geometry()).grid;
  int sides = 0;
  for_middles(grid, [&](Index e, BulgeMode mode, const Vec<3>& middle) {
    if (!grid.bulge(e) || std::popcount(mode.along) != 2) return;
    const auto level = [](const Vec<3>& X) { return X.cwiseQuotient(Vec<3>(1, 1.5, 1)).norm(); };
    for (unsigned a = 0; a < 8; ++a)
      if ((a & ~mode.along) == mode.upper && level(at(grid.X, at(at(grid.cells, e), a))) < 0.999)
        return;
    EXPECT_NEAR(level(middle), 1, 1e-14);
    ++sides;
  });
  EXPECT_EQ(sides, 96);
}

TEST(CurvedCells, StraightBodiesHaveNone) {
  Brick<3> box;
  box.cells = {3, 4, 5};
  box.centre = {1e4, -3, 0.1};
  EXPECT_TRUE(box.geometry().grid.bulges.empty());
  EXPECT_TRUE(box.geometry().grid.bulge_of.empty());
  // In a cylinder only the outer ring is curved, and only around the axis.
  const Grid<3> cylinder = shape_of<Cylinder>(4, 2).geometry().grid;
  EXPECT_EQ(cylinder.bulges.size(), 16u * 3);
  for (const auto& bulge : cylinder.bulges) EXPECT_EQ(std::popcount(bulge.curved), 1);
}

/// Eight bent cells, one of them missing: one cell touches the re-entrant edges without a facet
/// there.
Grid<3> bent_corner() {
  Brick<3> brick;
  brick.cells = {2, 2, 2};
  Grid<3> grid = brick.geometry().grid;
  grid.cells.pop_back();
  std::vector<SurfacePatch<3>> planes;
  for (int k = 0; k < 3; ++k)
    for (const Real level : {-0.5, 0.0, 0.5})
      planes.push_back(SurfacePatch<3>::plane(level * Vec<3>::Unit(k), Vec<3>::Unit(k)));
  grid.X.pop_back();  // the node that only the missing cell has
  return make_geometry<3>(grid, planes, false, smooth_map<3>([](const std::array<Jet<3>, 3>& X) {
                            auto x = X;
                            x[0] = X[0] + 0.3 * sin(2.0 * X[1]) + 0.2 * X[2] * X[2];
                            x[1] = X[1] + 0.2 * X[0] * X[0];
                            x[2] = X[2] + 0.2 * sin(2.0 * X[0]);
                            return x;
                          }))
      .grid;
}

TEST(CurvedCells, CellsWithAnEdgeOnTheBoundaryConform) {
  const Grid<3> grid = bent_corner();
  const NodalCells<3> cells(grid);
  CellQuadrature<3> q;
  Real total = 0;
  for (Index node = 0; node < cells.size(); ++node) {
    cells.quadrature(node, q);
    Vec<3> closed = Vec<3>::Zero();
    Mat<3> moment = Mat<3>::Zero();
    for (std::size_t p = 0; p < q.facet_X.size(); ++p) {
      closed += q.facet_dA[p];
      moment += q.facet_dA[p] * (q.facet_X[p] - cells.centroid(node)).transpose();
    }
    EXPECT_LT(closed.norm(), 1e-15);
    EXPECT_LT((moment - cells.volume(node) * Mat<3>::Identity()).norm(), 1e-15);
    total += cells.volume(node);
  }
  EXPECT_NEAR(total, volume(grid), 1e-14);
}

TEST(CurvedCells, OrderAndJitterKeepTheBulges) {
  Geometry<3> ball = shape_of<Ball>(4, 2).geometry();
  const Real V = volume(ball.grid);
  order_spatially(ball);
  EXPECT_NEAR(volume(ball.grid), V, 1e-14);
  jitter_interior(ball.grid, 0.2, 1);
  EXPECT_NEAR(volume(ball.grid), V, 1e-13);
  EXPECT_NO_THROW(check_jacobians(ball.grid, "Jitter"));
}

TEST(CurvedCells, FoldsOfBulgesAreFound) {
  Grid<2> disk = Disk{}.geometry().grid;
  ASSERT_FALSE(disk.bulges.empty());
  disk.bulges.front().deviation *= -50;
  EXPECT_THROW_WITH(check_jacobians(disk, "the test"), InputError, "the test folds cell");
}

}  // namespace
}  // namespace meniscus::test_geometry_curved
