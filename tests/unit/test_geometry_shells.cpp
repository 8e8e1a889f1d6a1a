// SPDX-License-Identifier: BSD-3-Clause
// Shells: exact volumes, areas, normals and curvatures of both surfaces, and the walls between
// them.
#include "body/grid/nodal_cells.hpp"
#include "body/imperfection.hpp"
#include "body/surface/surface_points.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meniscus::test_geometry_shells {
namespace {

constexpr Real pi = std::numbers::pi;

template <class Shell>
Shell shell(Real thickness, int layers, Real spacing) {
  Shell s;
  s.thickness = thickness;
  s.layers = layers;
  s.spacing = spacing;
  return s;
}

DiskShell cell_disk(Real spacing = 0.49, int layers = 4) {
  auto s = shell<DiskShell>(0.5, layers, spacing);
  s.radius = 5;
  s.height = 3;
  return s;
}

/// Volume within the distance `b` of a circular plate of radius `a`.
Real plate_volume(Real a, Real b) {
  return 2 * pi * a * a * b + pi * pi * a * b * b + 4.0 / 3 * pi * b * b * b;
}
Real plate_area(Real a, Real b) {
  return 2 * pi * a * a + 2 * pi * pi * a * b + 4 * pi * b * b;
}

Real area(const SurfacePoints<3>& points) {
  Real sum = 0;
  for (const Real a : points.area) sum += a;
  return sum;
}
/// Enclosed volume by the divergence theorem; negative if the normals point inwards.
Real enclosed(const SurfacePoints<3>& points) {
  Real sum = 0;
  for (Index q = 0; q < points.size(); ++q)
    sum += at(points.area, q) * at(points.X, q).dot(at(points.N, q)) / 3;
  return sum;
}

TEST(Shells, HaveTheParticlesOfLayersOnACubedSphere) {
  const Geometry<3> g = cell_disk().geometry();  // a quarter of the meridian is 5.856
  EXPECT_EQ(g.grid.node_count(), 4 * (6 * 12 * 12 + 2));
  EXPECT_EQ(g.grid.cell_count(), 3 * 6 * 12 * 12);
  EXPECT_EQ(surface_points(g, 1, SurfacePart::outer).size(), 6 * 12 * 12);
  EXPECT_EQ(surface_points(g, 1, SurfacePart::inner).size(), 6 * 12 * 12);
  EXPECT_EQ(surface_points(g, 1).size(), 12 * 12 * 12);
}

TEST(Shells, EncloseExactVolumesAndAreas) {
  const Geometry<3> g = cell_disk(0.25).geometry();
  const auto outer = surface_points(g, 4, SurfacePart::outer),
             inner = surface_points(g, 4, SurfacePart::inner);
  // The curvature jumps within facets across the circle where the rim begins.
  EXPECT_NEAR(area(outer), plate_area(3.5, 1.5), 2e-4 * area(outer));
  EXPECT_NEAR(area(inner), plate_area(3.5, 1.0), 2e-4 * area(inner));
  EXPECT_NEAR(enclosed(outer), plate_volume(3.5, 1.5), 2e-4 * enclosed(outer));
  EXPECT_NEAR(-enclosed(inner), plate_volume(3.5, 1.0), -2e-4 * enclosed(inner));
  EXPECT_NEAR(volume(g.grid), plate_volume(3.5, 1.5) - plate_volume(3.5, 1.0), 0.05);
}

TEST(Shells, SphereIsExact) {
  auto s = shell<SphereShell>(0.25, 3, 0.2);
  s.centre = {3, -1, 2};
  const Geometry<3> g = s.geometry();
  const Vec<3> centre(3, -1, 2);
  for (const SurfacePart part : {SurfacePart::outer, SurfacePart::inner}) {
    const Real R = part == SurfacePart::outer ? 1 : 0.75,
               sign = part == SurfacePart::outer ? 1 : -1;
    const auto points = surface_points(g, 3, part);
    EXPECT_NEAR(area(points), 4 * pi * R * R, 1e-6);
    for (Index q = 0; q < points.size(); ++q) {
      const Vec<3> n = (at(points.X, q) - centre).normalized();
      EXPECT_NEAR((at(points.X, q) - centre).norm(), R, 1e-13);
      EXPECT_LT((at(points.N, q) - sign * n).norm(), 1e-13);
      const Mat<3> exact = sign / R * (Mat<3>::Identity() - n * n.transpose());
      EXPECT_LT((at(points.grad_N, q) - exact).norm(), 1e-8);
    }
  }
}

/// Outer normals and director against a level set; the inner surface is parallel to the outer one.
template <class Shell, class Level>
void expect_parallel_walls(const Shell& s, Level&& level) {
  const Geometry<3> g = s.geometry();
  const auto outer = surface_points(g, 2, SurfacePart::outer),
             inner = surface_points(g, 2, SurfacePart::inner);
  constexpr Real h = 1e-5;
  for (Index q = 0; q < outer.size(); ++q) {
    const Vec<3>& X = at(outer.X, q);
    EXPECT_NEAR(level(X), 0, 1e-12);
    Vec<3> gradient;
    for (int k = 0; k < 3; ++k)
      gradient[k] = (level(X + h * Vec<3>::Unit(k)) - level(X - h * Vec<3>::Unit(k))) / (2 * h);
    EXPECT_LT((at(outer.N, q) - gradient.normalized()).norm(), 1e-8);
    EXPECT_LT((g.director(X) - at(outer.N, q)).norm(), 1e-9);
  }
  for (Index q = 0; q < inner.size(); ++q) {
    const Vec<3> n = -at(inner.N, q), X = at(inner.X, q);
    EXPECT_NEAR(level(X + s.thickness * n), 0, 1e-12);
    EXPECT_LT((g.director(X) - n).norm(), 1e-9);
    EXPECT_LT((g.director(X + 0.3 * s.thickness * n) - n).norm(), 1e-9);
  }
}

/// Distance to a box in the (r, z) plane, minus the radius.
auto rounded(Real radius, Real height, Real edge) {
  return [=](const Vec<3>& X) {
    const Vec<2> q(std::hypot(X[0], X[1]) - (radius - edge), std::abs(X[2]) - (height / 2 - edge));
    return q.cwiseMax(0).norm() - edge;
  };
}

TEST(Shells, WallsAreParallel) {
  expect_parallel_walls(cell_disk(), rounded(5, 3, 1.5));
  auto cylinder = shell<CylinderShell>(0.4, 4, 0.6);
  cylinder.radius = 5;
  cylinder.height = 3;
  cylinder.edge_radius = 0.75;
  expect_parallel_walls(cylinder, rounded(5, 3, 0.75));
  auto spheroid = shell<SpheroidShell>(0.4, 4, 0.5);
  spheroid.radius = 5;
  spheroid.height = 3;
  expect_parallel_walls(spheroid, [](const Vec<3>& X) {
    return (X[0] * X[0] + X[1] * X[1]) / 25 + X[2] * X[2] / 2.25 - 1;
  });
}

TEST(Shells, CellsTileTheWall) {
  auto spheroid = shell<SpheroidShell>(0.3, 4, 0.6);
  spheroid.radius = 3;
  spheroid.height = 4;
  for (const Geometry<3>& g : {cell_disk().geometry(), spheroid.geometry()}) {
    const NodalCells<3> cells(g.grid);
    Real sum = 0;
    for (Index A = 0; A < cells.size(); ++A) sum += cells.volume(A);
    EXPECT_NEAR(sum, volume(g.grid), 1e-11 * sum);
  }
}

TEST(Shells, MapHasExactDerivatives) {
  auto spheroid = shell<SpheroidShell>(0.3, 4, 0.6);
  spheroid.radius = 3;
  spheroid.height = 4;
  const SmoothMap<3> map = mapped_patches(*spheroid.geometry().surface).map();
  constexpr Real h = 1e-5;
  for (const Vec<3>& X : {Vec<3>(0.3, 0.5, 0.6), Vec<3>(-0.8, 0.1, -0.05), Vec<3>(0, 0, 0.9),
                          Vec<3>(2e-6, 1e-6, -0.7), Vec<3>(1e-3, 0, 0.8)}) {
    const MapPoint<3> p = map(X);
    for (int L = 0; L < 3; ++L) {
      const MapPoint<3> up = map(X + h * Vec<3>::Unit(L)), down = map(X - h * Vec<3>::Unit(L));
      EXPECT_LT((p.F.col(L) - (up.x - down.x) / (2 * h)).norm(), 1e-8) << X.transpose();
      for (int i = 0; i < 3; ++i)
        EXPECT_LT((at(p.G, i).col(L) - (up.F.row(i) - down.F.row(i)).transpose() / (2 * h)).norm(),
                  1e-6)
            << X.transpose();
    }
  }
}

TEST(Shells, ImperfectOnesKeepTheirNormals) {
  const Geometry<3> perfect = cell_disk().geometry(),
                    g = with_imperfection(cell_disk().geometry(), 0.1, 7);
  Real square = 0;
  for (Index A = 0; A < g.grid.node_count(); ++A)
    square += (at(g.grid.X, A) - at(perfect.grid.X, A)).squaredNorm();
  EXPECT_NEAR(std::sqrt(square / g.grid.node_count()), 0.1, 1e-12);
  for (const SurfacePart part : {SurfacePart::outer, SurfacePart::inner}) {
    const auto points = surface_points(g, 2, part);
    const Real sign = part == SurfacePart::outer ? 1 : -1;
    for (Index q = 0; q < points.size(); ++q)
      EXPECT_LT((g.director(at(points.X, q)) - sign * at(points.N, q)).norm(), 1e-9);
  }
  EXPECT_EQ(with_imperfection(cell_disk().geometry(), 0.1, 7).grid.X, g.grid.X);
  EXPECT_NE(with_imperfection(cell_disk().geometry(), 0.1, 8).grid.X, g.grid.X);
}

TEST(Shells, WithoutAParallelSurfaceAreRefused) {
  auto spheroid = shell<SpheroidShell>(0.5, 4, 0.5);
  spheroid.radius = 5;
  spheroid.height = 3;  // radius of the tip 1.5^2 / 5 = 0.45
  EXPECT_THROW_WITH(spheroid.geometry(), InputError,
                    "radius of 0.45, which must be larger than the thickness");
  auto cylinder = shell<CylinderShell>(0.5, 4, 0.5);
  cylinder.radius = 5;
  cylinder.height = 3;
  cylinder.edge_radius = 0.5;
  EXPECT_THROW_WITH(cylinder.geometry(), InputError,
                    "radius of 0.5, which must be larger than the thickness");
  cylinder.edge_radius = 1.6;
  EXPECT_THROW_WITH(cylinder.geometry(), InputError,
                    "the edge radius is 1.6, but the cylinder allows at most 1.5");
  auto disk = cell_disk();
  disk.height = 10.5;
  EXPECT_THROW_WITH(disk.geometry(), InputError, "cannot have a round rim of the height 10.5");
}

}  // namespace
}  // namespace meniscus::test_geometry_shells
