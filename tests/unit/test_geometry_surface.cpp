// SPDX-License-Identifier: BSD-3-Clause
// Smooth maps and quadrature points of the exact surface.
#include "body/surface/surface_points.hpp"
#include "meniscus/body/shapes.hpp"
#include "straight_grid.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace meniscus::test_geometry_surface {
namespace {

using std::numbers::pi;

template <int D>
SmoothMap<D> bent() {
  return smooth_map<D>([](const std::array<Jet<D>, D>& X) {
    auto x = X;
    x[0] = X[0] + 0.2 * sin(2.0 * X[1]) + 0.1 * X[0] * X[0];
    x[1] = X[1] * (1.0 + 0.3 * cos(X[0])) - 0.05 * X[D - 1] * X[0];
    return x;
  });
}

/// F and G against fourth-order differences of x and F.
template <int D>
void expect_derivatives(const SmoothMap<D>& map) {
  const Real h = 1e-3;
  const Vec<D> X = Vec<D>::LinSpaced(0.3, -0.5);
  const MapPoint<D> point = map(X);
  for (int K = 0; K < D; ++K) {
    const auto sample = [&](Real step) { return map(X + step * h * Vec<D>::Unit(K)); };
    const MapPoint<D> a = sample(1), b = sample(-1), c = sample(2), d = sample(-2);
    const Vec<D> slope = (8 * (a.x - b.x) - (c.x - d.x)) / (12 * h);
    const Mat<D> second = (8 * (a.F - b.F) - (c.F - d.F)) / (12 * h);
    for (int i = 0; i < D; ++i) {
      EXPECT_NEAR(point.F(i, K), slope[i], 3e-11);
      for (int L = 0; L < D; ++L) EXPECT_NEAR(at(point.G, i)(L, K), second(i, L), 1e-10);
      EXPECT_LT((at(point.G, i) - at(point.G, i).transpose()).norm(), 1e-15);
    }
  }
}

TEST(SmoothMap, DerivativesMatchFiniteDifferences) {
  expect_derivatives(twist_ellipsoid());
  expect_derivatives(biconcave());
  expect_derivatives(bent<2>());
  expect_derivatives(bent<3>());
}

TEST(SmoothMap, CompositionFollowsTheChainRule) {
  expect_derivatives(compose<3>(bent<3>(), twist_ellipsoid()));
  Mat<2> A;
  A << 1.2, 0.3, -0.1, 0.8;
  expect_derivatives(compose<2>(affine_map<2>(A, Vec<2>(1, 2)), bent<2>()));
}

TEST(SmoothMap, TwistTakesSphereToEllipsoid) {
  const MapPoint<3> point = twist_ellipsoid()(Vec<3>(2.0 / 3, -1.0 / 3, 2.0 / 3));
  EXPECT_NEAR(point.x.cwiseQuotient(Vec<3>(1, 1.5, 1)).norm(), 1, 1e-15);
  // Twists keep volume.
  EXPECT_NEAR(point.F.determinant(), 1.5, 1e-14);
}

template <int D>
Real total_area(const SurfacePoints<D>& points) {
  Real sum = 0;
  for (const Real a : points.area) sum += a;
  return sum;
}

/// Volume by the divergence theorem: oint X . N dA / D.
template <int D>
Real enclosed(const SurfacePoints<D>& points) {
  Real sum = 0;
  for (Index q = 0; q < points.size(); ++q)
    sum += at(points.X, q).dot(at(points.N, q)) * at(points.area, q) / D;
  return sum;
}

Ball coarse_ball() {
  Ball ball;
  ball.radius = 2;
  ball.core = 4;
  ball.layers = 2;
  ball.centre = {1, -2, 3};
  return ball;
}

TEST(SurfacePoints, SphereIsExact) {
  const auto points = surface_points(coarse_ball().geometry(), 3);
  EXPECT_TRUE(points.exact);
  ASSERT_EQ(points.size(), 96 * 9);
  for (Index q = 0; q < points.size(); ++q) {
    const Vec<3> arm = at(points.X, q) - Vec<3>(1, -2, 3), N = arm / 2;
    EXPECT_NEAR(arm.norm(), 2, 1e-14);
    EXPECT_LT((at(points.N, q) - N).norm(), 1e-15);
    EXPECT_LT((at(points.grad_N, q) - (Mat<3>::Identity() - N * N.transpose()) / 2).norm(), 2e-15);
    EXPECT_EQ(at(points.facet, q), q / points.per_facet);
  }
}

/// Each further Gauss point per direction gains a constant factor, down to rounding.
template <int D>
void expect_spectral(const Geometry<D>& body, Real area, Real content, Real gain) {
  Real previous = std::abs(total_area(surface_points(body, 2)) / area - 1);
  for (int k = 3; k <= 5; ++k) {
    const Real error = std::abs(total_area(surface_points(body, k)) / area - 1);
    EXPECT_LT(error, std::max(previous / gain, 2e-14)) << k;
    previous = error;
  }
  const auto points = surface_points(body, 10);
  EXPECT_NEAR(total_area(points) / area, 1, 1e-13);
  EXPECT_NEAR(enclosed(points) / content, 1, 1e-13);
}

TEST(SurfacePoints, AreaAndVolumeConvergeSpectrally) {
  expect_spectral(coarse_ball().geometry(), 16 * pi, 32 * pi / 3, 30);

  Ellipsoid spheroid;
  spheroid.semi_axes = {1, 1.5, 1};
  const Real e = std::sqrt(1 - 1 / 2.25);
  const Real area = 2 * pi * (1 + 1.5 / e * std::asin(e));
  expect_spectral(spheroid.geometry(), area, 2 * pi, 30);

  Geometry<3> twisted = apply_map(twist_ellipsoid(), Ball{}.geometry());
  expect_spectral(twisted, area, 2 * pi, 10);

  Cylinder cylinder;
  cylinder.radius = 2;
  cylinder.height = 3;
  cylinder.core = 4;
  cylinder.rings = 2;
  cylinder.layers = 2;
  expect_spectral(cylinder.geometry(), 4 * pi * 3 + 8 * pi, 12 * pi, 10);

  Disk disk;
  disk.radius = 3;
  disk.core = 4;
  disk.rings = 2;
  expect_spectral(disk.geometry(), 6 * pi, 9 * pi, 30);
}

/// Normal of the ellipsoid with these semi-axes at any point, and of all ellipsoids of its family.
Vec<3> ellipsoid_normal(const Vec<3>& X, const Vec<3>& axes) {
  return X.cwiseQuotient(axes.cwiseProduct(axes)).normalized();
}

TEST(SurfacePoints, EllipsoidNormalAndGradientMatchItsEquation) {
  // The twisted map reaches the same ellipsoid with other points. Both must satisfy the equation.
  const Vec<3> axes(1, 1.5, 1);
  const auto points = surface_points(apply_map(twist_ellipsoid(), Ball{}.geometry()), 2);
  const Real h = 1e-3;
  for (Index q = 0; q < points.size(); q += 37) {
    const Vec<3> X = at(points.X, q), N = ellipsoid_normal(X, axes);
    EXPECT_NEAR(X.cwiseQuotient(axes).norm(), 1, 1e-14);
    EXPECT_LT((at(points.N, q) - N).norm(), 1e-14);
    Mat<3> gradient;
    for (int K = 0; K < 3; ++K) {
      const auto n = [&](Real s) { return ellipsoid_normal(X + s * h * Vec<3>::Unit(K), axes); };
      gradient.col(K) = (8 * (n(1) - n(-1)) - (n(2) - n(-2))) / (12 * h);
    }
    const Mat<3> P = Mat<3>::Identity() - N * N.transpose();
    EXPECT_LT((at(points.grad_N, q) - P * gradient * P).norm(), 1e-11);
  }
}

TEST(SurfacePoints, CarriedInStagesEqualsOneMap) {
  Ball unit;
  unit.core = 4;
  unit.layers = 2;
  const Geometry<3> ball = unit.geometry();
  auto stages = surface_points(ball, 2);
  deform(stages, twist_ellipsoid());
  deform(stages, bent<3>());
  const auto once = surface_points(apply_map(compose<3>(bent<3>(), twist_ellipsoid()), ball), 2);
  for (Index q = 0; q < once.size(); ++q) {
    EXPECT_LT((at(stages.X, q) - at(once.X, q)).norm(), 1e-13);
    EXPECT_LT((at(stages.N, q) - at(once.N, q)).norm(), 1e-13);
    EXPECT_LT((at(stages.grad_N, q) - at(once.grad_N, q)).norm(),
              1e-12 * (1 + at(once.grad_N, q).norm()));
    EXPECT_NEAR(at(stages.area, q), at(once.area, q), 1e-13 * at(once.area, q));
  }
}

TEST(SurfacePoints, EllipseCurvature) {
  Ellipse ellipse;
  ellipse.semi_axes = {2, 1};
  const auto points = surface_points(ellipse.geometry(), 3);
  for (Index q = 0; q < points.size(); ++q) {
    const Vec<2> X = at(points.X, q);
    const Real expected = std::pow(X[0] * X[0] / 16 + X[1] * X[1], -1.5) / 4;
    EXPECT_NEAR(at(points.grad_N, q).trace(), expected, 1e-14 * expected + 4e-15);
  }
}

TEST(SurfacePoints, BoxFacesAreFlat) {
  Brick<3> box;
  box.size = {1, 2, 3};
  box.cells = {2, 2, 2};
  const auto points = surface_points(box.geometry(), 2);
  EXPECT_NEAR(total_area(points), 22, 1e-13);
  EXPECT_NEAR(enclosed(points), 6, 1e-13);
  for (const auto& grad_N : points.grad_N) EXPECT_EQ(grad_N.norm(), 0);
}

TEST(SurfacePoints, FlatFacetsEncloseTheGrid) {
  const Grid<3> grid = test::straight(coarse_ball().geometry().grid);
  const auto points = facet_points(grid, 2);
  EXPECT_FALSE(points.exact);
  EXPECT_NEAR(enclosed(points), volume(grid), 1e-12);
  const Grid<2> disk = test::straight(Disk{}.geometry().grid);
  EXPECT_NEAR(enclosed(facet_points(disk, 1)), volume(disk), 1e-13);
}

}  // namespace
}  // namespace meniscus::test_geometry_surface
