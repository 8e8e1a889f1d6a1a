// SPDX-License-Identifier: BSD-3-Clause
// Grids of the shapes: counts, volumes, boundaries, checks, jitter.
#include "body/grid/simplex.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"
#include "straight_grid.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace meniscus::test_geometry_shapes {
namespace {

using std::numbers::pi;

TEST(Shapes, BallCountsAndVolume) {
  const Geometry<3> ball = Ball{}.geometry();
  EXPECT_EQ(ball.grid.node_count(), 4341);
  EXPECT_EQ(ball.grid.cell_count(), 4000);
  EXPECT_EQ(ball.grid.facets.size(), 600u);
  EXPECT_EQ(boundary_nodes(ball.grid).size(), 602u);
  // Reference value of the cubed sphere with n = 10, m = 5, a = 0.5, w = 0.7.
  EXPECT_NEAR(volume(test::straight(ball.grid)), 4.1437736935676135, 1e-12);
  EXPECT_NEAR(volume(ball.grid) / (4 * pi / 3), 1, 4e-6);
  EXPECT_TRUE(ball.surface->smooth());
}

TEST(Shapes, HalfSphereIsHalfABall) {
  HalfSphere shape;
  shape.core = 6;
  shape.layers = 3;
  shape.radius = 2;
  shape.centre = {1, 2, 3};
  const Geometry<3> body = shape.geometry();
  EXPECT_EQ(body.grid.cell_count(), (6 * 6 * 6 + 6 * 36 * 3) / 2);
  // Both halves contain the nodes of the common plane: 7^2 of the core and 24 in each shell.
  Ball whole;
  whole.core = 6;
  whole.layers = 3;
  const Index in_plane = 49 + 3 * 24;
  EXPECT_EQ(2 * body.grid.node_count() - in_plane, whole.geometry().grid.node_count());
  EXPECT_NEAR(volume(body.grid), 4 * volume(whole.geometry().grid), 1e-12);
  EXPECT_FALSE(body.surface->smooth());
  std::array<std::size_t, 2> facets{};
  for (const auto& facet : body.grid.facets) {
    ++at(facets, facet.patch);
    for (const Index i : facet.nodes) {
      const Vec<3> X = at(body.grid.X, i) - Vec<3>(1, 2, 3);
      EXPECT_NEAR(facet.patch == 0 ? X.norm() - 2 : X[2], 0, 1e-14);
    }
  }
  EXPECT_EQ(facets, (std::array<std::size_t, 2>{3 * 36, 36 + 3 * 24}));
  shape.below = true;
  const Geometry<3> turned = shape.geometry();
  EXPECT_NEAR(volume(turned.grid), volume(body.grid), 1e-12);
  for (Index i = 0; i < body.grid.node_count(); ++i) {
    const Vec<3> X = at(body.grid.X, i) - Vec<3>(1, 2, 3),
                 Y = at(turned.grid.X, i) - Vec<3>(1, 2, 3);
    EXPECT_NEAR((Y - Vec<3>(X[0], -X[1], -X[2])).norm(), 0, 1e-14);
  }
  shape.core = 5;
  EXPECT_THROW_WITH(shape.geometry(), InputError, "even number of cells along the core");
}

template <int D>
Geometry<D> shape_of(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  Geometry<D> body = read_geometry<D>(input.root());
  return body;
}

/// Distances of the nodes along an axis from the middle, in their order.
template <int D>
std::vector<Real> along(const Grid<D>& grid, int axis) {
  std::vector<Real> found;
  for (const Vec<D>& X : grid.X)
    if ((X - X[axis] * Vec<D>::Unit(axis)).norm() < 1e-12 && X[axis] > -1e-12)
      found.push_back(X[axis]);
  std::sort(found.begin(), found.end());
  return found;
}

TEST(Shapes, AnOctantIsAnEighthOfABallWhoseShellsGrow) {
  const Geometry<3> body =
      shape_of<3>("shape = \"octant\"\nradius = 2\ncore = 8\nlayers = 5\ngrading = 1.5\n");
  EXPECT_EQ(body.grid.cell_count(), 64 + 3 * 16 * 5);
  EXPECT_EQ(body.grid.node_count(), 125 + 5 * 61);
  EXPECT_NEAR(volume(body.grid) / (8 * pi / 6), 1, 2e-5);
  std::array<std::size_t, 4> facets{};
  for (const auto& facet : body.grid.facets) {
    ++at(facets, facet.patch);
    for (const Index i : facet.nodes) {
      const Vec<3>& X = at(body.grid.X, i);
      EXPECT_NEAR(facet.patch == 0 ? X.norm() - 2 : X[facet.patch - 1], 0, 1e-14);
    }
  }
  EXPECT_EQ(facets, (std::array<std::size_t, 4>{48, 56, 56, 56}));
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<Real> z = along(body.grid, axis);
    ASSERT_EQ(z.size(), 10u);
    for (std::size_t k = 5; k + 1 < z.size(); ++k)
      EXPECT_NEAR((z[k + 1] - z[k]) / (z[k] - z[k - 1]), 1.5, k == 5 ? 1.5 : 1e-12) << k;
    EXPECT_GT((z[9] - z[8]) / z[1], 6);
  }
  const SceneInput odd = SceneInput::from_text("shape = \"octant\"\nradius = 1\ncore = 5\n");
  read_geometry<3>(odd.root());
  EXPECT_FALSE(odd.root().in_order());
}

TEST(Shapes, AHalfDiskMayBeGradedToo) {
  const auto text = [](const char* more) {
    return std::string("shape = \"half_disk\"\nradius = 1\ncore = 8\nrings = 5\n") + more;
  };
  const Geometry<2> graded = shape_of<2>(text("grading = 1.5\n")), even = shape_of<2>(text(""));
  EXPECT_EQ(graded.grid.node_count(), even.grid.node_count());
  EXPECT_NEAR(volume(graded.grid) / (pi / 2), 1, 3e-5);
  const std::vector<Real> fine = along(graded.grid, 1), equal = along(even.grid, 1);
  EXPECT_LT(fine[1], 0.45 * equal[1]);
  for (std::size_t k = 6; k + 1 < fine.size(); ++k) {
    EXPECT_NEAR((fine[k + 1] - fine[k]) / (fine[k] - fine[k - 1]), 1.5, 1e-12);
    EXPECT_NEAR((equal[k + 1] - equal[k]) / (equal[k] - equal[k - 1]), 1, 1e-12);
  }
}

TEST(Shapes, CylinderCountsAndVolume) {
  Cylinder cylinder;
  cylinder.radius = 2;
  cylinder.height = 0.5;
  cylinder.centre = {1, 2, 3};
  const Geometry<3> body = cylinder.geometry();
  EXPECT_EQ(body.grid.node_count(), 4036);
  EXPECT_EQ(body.grid.cell_count(), 2916);
  EXPECT_FALSE(body.surface->smooth());
  // The cross-section is a regular 72-gon; with curved sides it is a circle up to 1.2e-7.
  EXPECT_NEAR(volume(test::straight(body.grid)), 0.5 * 36 * 4 * std::sin(2 * pi / 72), 1e-12);
  EXPECT_NEAR(volume(body.grid) / (2 * pi), 1, 1.3e-7);
  std::array<std::size_t, 3> facets{};
  for (const auto& facet : body.grid.facets) ++at(facets, facet.patch);
  EXPECT_EQ(facets, (std::array<std::size_t, 3>{216, 972, 972}));
}

TEST(Shapes, DiskCountsAndArea) {
  const Geometry<2> disk = Disk{}.geometry();
  EXPECT_EQ(disk.grid.node_count(), 1009);
  EXPECT_EQ(disk.grid.cell_count(), 972);
  EXPECT_EQ(disk.grid.facets.size(), 72u);
  EXPECT_NEAR(volume(test::straight(disk.grid)), 36 * std::sin(2 * pi / 72), 1e-13);
  EXPECT_NEAR(volume(disk.grid) / pi, 1, 1.3e-7);
}

TEST(Shapes, EveryCoreAndLayerNumberIsValid) {
  for (const int core : {1, 2, 5, 12})
    for (const int layers : {1, 2, 7}) {
      Ball ball;
      ball.core = core;
      ball.layers = layers;
      Disk disk;
      disk.core = core;
      disk.rings = layers;
      EXPECT_NO_THROW(ball.geometry()) << core << ' ' << layers;
      EXPECT_NO_THROW(disk.geometry()) << core << ' ' << layers;
    }
}

TEST(Shapes, EllipsoidIsAStretchedBall) {
  Ellipsoid ellipsoid;
  ellipsoid.semi_axes = {1, 1.5, 2};
  ellipsoid.centre = {-1, 0, 4};
  const Geometry<3> body = ellipsoid.geometry();
  EXPECT_NEAR(volume(test::straight(body.grid)), 3 * 4.1437736935676135, 1e-11);
  EXPECT_NEAR(volume(body.grid), 3 * volume(Ball{}.geometry().grid), 1e-11);
  for (const Index i : boundary_nodes(body.grid)) {
    const Vec<3> X = at(body.grid.X, i) - Vec<3>(-1, 0, 4);
    EXPECT_NEAR(X.cwiseQuotient(Vec<3>(1, 1.5, 2)).norm(), 1, 1e-14);
  }
}

TEST(Shapes, BoxBySpacingFromCorner) {
  Brick<3> box;
  box.size = {1, 0.5, 0.25};
  box.spacing = 0.1;
  box.corner = {1, 2, 3};
  const Geometry<3> body = box.geometry();
  EXPECT_EQ(body.grid.cell_count(), 10 * 5 * 3);
  EXPECT_EQ(body.grid.node_count(), 11 * 6 * 4);
  EXPECT_EQ(body.grid.facets.size(), 2u * (50 + 30 + 15));
  EXPECT_NEAR(volume(body.grid), 0.125, 4e-15);
  EXPECT_NEAR((body.grid.X.front() - Vec<3>(1, 2, 3)).norm(), 0, 1e-15);
  EXPECT_NEAR((body.grid.X.back() - Vec<3>(2, 2.5, 3.25)).norm(), 0, 1e-15);
  std::set<int> patches;
  for (const auto& facet : body.grid.facets) patches.insert(facet.patch);
  EXPECT_EQ(patches, (std::set<int>{0, 1, 2, 3, 4, 5}));
}

TEST(Shapes, BoxNeedsCellsOrSpacing) {
  Brick<2> box;
  EXPECT_THROW_WITH(box.geometry(), InputError, "either the cells per direction or the spacing");
  box.spacing = 0.1;
  box.cells = {10, 10};
  EXPECT_THROW_WITH(box.geometry(), InputError, "either the cells per direction or the spacing");
  box.spacing = 0;
  box.cells = {10, 2.5};
  EXPECT_THROW_WITH(box.geometry(), InputError, "must be whole, from 1 to 1e6");
  box.cells = {1e5, 1e5};
  EXPECT_THROW_WITH(box.geometry(), InputError, "cells; ");
  box.cells = {2, 2};
  EXPECT_NO_THROW(box.geometry());
  box.corner = box.centre = {0, 0};
  EXPECT_THROW_WITH(box.geometry(), InputError, "either the corner or the centre");
}

TEST(Shapes, AreRegisteredWithTheirKeys) {
  for (const char* name : {"ball", "ellipsoid", "half_sphere", "octant", "cylinder", "box"})
    EXPECT_NE(shapes<3>().find(name), nullptr) << name;
  for (const char* name : {"disk", "ellipse", "rectangle"})
    EXPECT_NE(shapes<2>().find(name), nullptr) << name;
  const auto keys = shapes<3>().at("ball").keys();
  ASSERT_EQ(keys.size(), 5u);
  EXPECT_EQ(keys[0].key, "radius");
  EXPECT_FALSE(keys[0].meaning.empty());
}

template <int D>
void expect_outward(const Grid<D>& grid) {
  for (const auto& facet : grid.facets) {
    Vec<D> middle = Vec<D>::Zero(), inside = Vec<D>::Zero();
    for (const Index i : facet.nodes)
      middle += at(grid.X, i) / static_cast<Real>(facet.nodes.size());
    for (const Index i : at(grid.cells, facet.cell)) inside += at(grid.X, i) / Grid<D>::corners;
    const Vec<D> a = at(grid.X, facet.nodes[1]) - at(grid.X, facet.nodes[0]);
    if constexpr (D == 3) {
      const Vec<3> b = at(grid.X, facet.nodes[2]) - at(grid.X, facet.nodes[0]);
      EXPECT_GT(a.cross(b).dot(middle - inside), 0);
    } else {
      EXPECT_GT(Vec<2>(a[1], -a[0]).dot(middle - inside), 0);
    }
  }
}

TEST(Shapes, AreReadFromScenes) {
  const auto scene = SceneInput::from_text(R"(
    [disk]
    shape = "disk"
    radius = "2 mm"
    core = 4
    rings = 2
    centre = [1, 0]
    [box]
    shape = "box"
    size = [1, 1, 2]
    spacing = 0.5
    jitter = 0.2
    jitter_seed = 3
  )");
  const Block disk = *scene.root().table("disk"), box = *scene.root().table("box");
  const Geometry<2> round = read_geometry<2>(disk);
  const Geometry<3> jittered = read_geometry<3>(box);
  disk.done();
  box.done();
  scene.check();
  EXPECT_EQ(round.grid.cell_count(), 16 + 32);
  EXPECT_NEAR(volume(test::straight(round.grid)), 8 * std::sin(2 * pi / 16) * 4e-6, 1e-18);
  EXPECT_EQ(jittered.grid.cell_count(), 16);
  EXPECT_NE(at(jittered.grid.X, 13), Vec<3>(0, 0, -0.5));
}

TEST(Shapes, ProblemsOfScenesAreNotedOnce) {
  const auto scene = SceneInput::from_text(R"(
    [one]
    shape = "rectangle"
    size = [1, 1]
    [two]
    shape = "disk"
    radius = -1
    [three]
    shape = "disc"
    radius = 1
  )");
  for (const char* name : {"one", "two", "three"}) {
    const Block block = *scene.root().table(name);
    EXPECT_GT(read_geometry<2>(block).grid.cell_count(), 0);
  }
  try {
    scene.check();
    FAIL();
  } catch (const InputError& error) {
    const std::string report = error.what();
    EXPECT_EQ(std::count(report.begin(), report.end(), '\n'), 2) << report;
    EXPECT_NE(report.find("cells per direction or the spacing"), std::string::npos) << report;
    EXPECT_NE(report.find("two.radius"), std::string::npos) << report;
    EXPECT_NE(report.find("three.shape"), std::string::npos) << report;
  }
}

TEST(Grid, FacetsAreOutward) {
  expect_outward(Ball{}.geometry().grid);
  expect_outward(Cylinder{}.geometry().grid);
  expect_outward(Disk{}.geometry().grid);
}

TEST(Grid, TriangulationEnclosesTheVolume) {
  const Grid<3> ball = test::straight(Ball{}.geometry().grid);
  Real enclosed = 0;
  for (const auto& t : triangulate_boundary(ball)) {
    Mat<3> X;
    for (int a = 0; a < 3; ++a) X.col(a) = at(ball.X, at(t, a));
    enclosed += X.determinant() / 6;
  }
  EXPECT_EQ(triangulate_boundary(ball).size(), 1200u);
  // The shorter diagonal of a facet on a sphere is the outer one.
  EXPECT_GT(enclosed, volume(ball));
  EXPECT_NEAR(enclosed, volume(ball), 1e-3 * enclosed);

  const Grid<2> disk = test::straight(Disk{}.geometry().grid);
  Real area = 0;
  for (const auto& s : triangulate_boundary(disk)) {
    const Vec<2> a = at(disk.X, s[0]), b = at(disk.X, s[1]);
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  EXPECT_NEAR(area, volume(disk), 1e-13);
}

TEST(Grid, FoldedCellIsNamed) {
  Brick<2> brick;
  brick.cells = {2, 2};
  Grid<2> grid = brick.geometry().grid;
  std::swap(at(grid.X, 4), at(grid.X, 8));
  try {
    check_jacobians(grid, "the test");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the test folds cell 1 at (0.5, 0)"),
              std::string::npos)
        << error.what();
  }
}

TEST(Grid, SideOfThreeCellsIsRefused) {
  Brick<2> brick;
  brick.cells = {2, 1};
  Grid<2> grid = brick.geometry().grid;
  grid.cells.push_back(grid.cells.front());
  EXPECT_THROW_WITH(find_boundary(grid), InputError, "share one side");
}

TEST(Grid, JitterMovesInteriorNodesReproducibly) {
  const Grid<3> plain = Ball{}.geometry().grid;
  Grid<3> first = plain, second = plain, other = plain;
  jitter_interior(first, 0.2, 1);
  jitter_interior(second, 0.2, 1);
  jitter_interior(other, 0.2, 2);
  std::vector<char> fixed(plain.X.size(), 0);
  for (const Index i : boundary_nodes(plain)) at(fixed, i) = 1;
  for (Index i = 0; i < plain.node_count(); ++i) {
    EXPECT_EQ(at(first.X, i), at(second.X, i));
    EXPECT_EQ(at(first.X, i) == at(plain.X, i), at(fixed, i) == 1);
    EXPECT_EQ(at(first.X, i) == at(other.X, i), at(fixed, i) == 1);
  }
  EXPECT_NEAR(volume(first), volume(plain), 1e-12);
}

TEST(Grid, JitterSequenceIsFixed) {
  Brick<2> brick;
  brick.cells = {2, 2};
  brick.size = {2, 2};
  Grid<2> grid = brick.geometry().grid;
  jitter_interior(grid, 0.25, 5489);
  // The first two numbers of the standard's mt19937_64 with its default seed 5489.
  const auto number = [](std::uint64_t bits) {
    return 0.25 * (2 * (static_cast<Real>(bits >> 11) * 0x1p-53) - 1);
  };
  EXPECT_EQ(at(grid.X, 4)[0], number(14514284786278117030ull));
  EXPECT_EQ(at(grid.X, 4)[1], number(4620546740167642908ull));
}

TEST(Grid, StrongJitterFoldsNoCell) {
  Brick<3> brick;
  brick.cells = {6, 6, 6};
  Grid<3> grid = brick.geometry().grid;
  jitter_interior(grid, 0.4, 1);
  EXPECT_NO_THROW(check_jacobians(grid, "Jitter"));
}

TEST(Grid, ImpossibleJitterIsRefused) {
  Grid<2> grid = Disk{}.geometry().grid;
  EXPECT_THROW_WITH(jitter_interior(grid, 1e6, 1), InputError, "folds the cells at node");
  EXPECT_THROW_WITH(jitter_interior(grid, -0.1, 1), InputError, "must not be negative");
}

template <int D>
void expect_diagonals(const Grid<D>& grid, const Mat<D>& stretch, Real length) {
  for (const Real found : diagonals_around_nodes(grid, stretch)) EXPECT_NEAR(found, length, 1e-14);
  for (const Real found : supports_by_cells(grid, stretch, 1.5))
    EXPECT_NEAR(found, 1.5 * length, 1e-14);
}

/// Unlike distances to neighbours, diagonals do not grow at faces, edges and corners.
TEST(Grid, DiagonalsOfALatticeAreTheSameEverywhere) {
  Brick<3> brick;
  brick.cells = {2, 3, 4};
  brick.size = {1, 1.5, 2};
  expect_diagonals<3>(brick.geometry().grid, Mat<3>::Identity(), std::sqrt(0.75));
  Brick<2> long_cells;
  long_cells.cells = {3, 3};
  long_cells.size = {6, 1.5};
  expect_diagonals<2>(long_cells.geometry().grid, Mat<2>::Identity(), std::sqrt(4.25));
  expect_diagonals<2>(long_cells.geometry().grid, Vec<2>(2, 0.5).asDiagonal(), std::sqrt(2));
}

TEST(Grid, DiagonalsOfSimplicesAreThoseOfTheCubeTheyFill) {
  Grid<2> square;
  square.X = {{0, 0}, {3, 0}, {0, 3}, {3, 3}};
  using Triangle = std::array<Index, 3>;
  square.cells = {collapsed(Triangle{0, 1, 3}), collapsed(Triangle{0, 3, 2})};
  expect_diagonals<2>(square, Mat<2>::Identity(), 3 * std::sqrt(2));
  Grid<3> cube;  // six tetrahedra around a diagonal
  for (int k = 0; k < 8; ++k) cube.X.push_back({Real(k & 1), Real(k >> 1 & 1), Real(k >> 2)});
  using Tetrahedron = std::array<Index, 4>;
  for (const auto& [a, b] : {std::pair{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}})
    cube.cells.push_back(collapsed(Tetrahedron{0, a, b, 7}));
  expect_diagonals<3>(cube, Mat<3>::Identity(), std::sqrt(3));
}

/// A node between cells of two sizes has the mean of their diagonals.
TEST(Grid, DiagonalsAreAveragedOverCells) {
  Grid<2> grid;
  grid.X = {{0, 0}, {1, 0}, {3, 0}, {0, 1}, {1, 1}, {3, 1}};
  grid.cells = {{0, 1, 3, 4}, {1, 2, 4, 5}};
  const auto length = diagonals_around_nodes<2>(grid, Mat<2>::Identity());
  EXPECT_NEAR(length[0], std::sqrt(2), 1e-15);
  EXPECT_NEAR(length[1], 0.5 * (std::sqrt(2) + std::sqrt(5)), 1e-15);
  EXPECT_NEAR(length[5], std::sqrt(5), 1e-15);
}

TEST(Grid, GaussPointsIntegratePolynomials) {
  Brick<3> brick;
  brick.cells = {2, 3, 1};
  brick.corner = {0, 0, 0};
  const CellPoints<3> points = cell_gauss_points(brick.geometry().grid, 3);
  EXPECT_EQ(points.per_cell, 27);
  Real sum = 0;
  for (std::size_t q = 0; q < points.X.size(); ++q)
    sum += points.weight[q] * std::pow(points.X[q][0], 5) * std::pow(points.X[q][2], 4);
  EXPECT_NEAR(sum, 1.0 / 30, 1e-15);
}

}  // namespace
}  // namespace meniscus::test_geometry_shapes
