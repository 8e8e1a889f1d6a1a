// SPDX-License-Identifier: BSD-3-Clause
// Bodies mapped by formulas, rotated and moved; derivatives of formulas.
#include "body/shapes/placement.hpp"
#include "body/surface/surface_points.hpp"
#include "geometry_of_lines.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"
#include "numbers/box.hpp"
#include "numbers/dense.hpp"
#include "numbers/jet.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace meniscus::test_placement {
namespace {

const Eigen::Vector3d place(0.3, 0.7, -0.4);

/// f' by central differences of order 8.
template <class F>
auto slope(F f, Real h) -> decltype(f(h)) {
  return (0.8 * (f(h) - f(-h)) - 0.2 * (f(2 * h) - f(-2 * h)) + 4.0 / 105 * (f(3 * h) - f(-3 * h)) -
          1.0 / 280 * (f(4 * h) - f(-4 * h))) /
         h;
}

TEST(FormulaDerivatives, AreThoseOfTheFunction) {
  for (const char* formula :
       {"x", "3*x - y/z + x*y*z", "sin(x)*cos(y) + tan(z)", "asin(x) + acos(z) + atan(x*y)",
        "atan2(y, x) + atan2(z, -x*y)", "sinh(x) - cosh(y*z) + tanh(x + y)",
        "exp(-x^2/0.3) + log(y) + log10(x + y)", "sqrt(x + y^2) + cbrt(z)",
        "abs(z) + sign(z)*x + floor(x) + ceil(y)", "erf(x - z)", "pow(y, x) + y^2.5 + x^-2 + 2^z",
        "x > 0 && y < 0.5 ? x^3 : y^3", "x == y || z != 0 ? -x^2 : x", "min(x, y, z) + max(x, y^2)",
        "a*x^2 + 2^-x + -y^2*3", "(x <= 0.2) + (x >= 0.2)*x - e^x + pi*y"}) {
    const Expression f(formula, {{"a", 1.5}});
    const Jet<3> jet = f.jet(place);
    EXPECT_EQ(jet.value, f(place)) << formula;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d e = Eigen::Vector3d::Unit(k);
      const Real expected = slope([&](Real s) { return f(place + s * e); }, 4e-3);
      EXPECT_NEAR(jet.gradient[k], expected, 1e-10 * (1 + std::abs(expected))) << formula << k;
      const Eigen::Vector3d bends =
          slope([&](Real s) -> Eigen::Vector3d { return f.jet(place + s * e).gradient; }, 4e-3);
      for (int l = 0; l < 3; ++l)
        EXPECT_NEAR(jet.hessian(l, k), bends[l], 1e-9 * (1 + std::abs(bends[l]))) << formula;
    }
    EXPECT_LT((jet.hessian - jet.hessian.transpose()).norm(), 1e-14) << formula;
  }
}

TEST(FormulaDerivatives, KnowTimeAndConstants) {
  EXPECT_EQ(Expression("t*x").jet(place, 4).gradient[0], 4);
  EXPECT_TRUE(Expression("2*pi").jet(place).gradient.isZero(0));
  EXPECT_EQ(Expression("x^0").jet({0, 0, 0}).hessian(0, 0), 0);
  EXPECT_EQ(Expression("x^2").jet({0, 0, 0}).hessian(0, 0), 2);
}

template <int D>
std::string problem(const std::string& lines) {
  try {
    test::geometry_of_lines<D>(lines);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Placement, FormulasAreTheMapsOfTheStudies) {
  const SmoothMap<3> written =
      formula_map<3>({Expression("x"), Expression("y"),
                      Expression("z/2*(0.207161 + (x^2+y^2)*(2.002558 - 1.122762*(x^2+y^2)))")});
  const MapPoint<3> found = written(place), expected = biconcave()(place);
  EXPECT_LT((found.x - expected.x).norm(), 1e-15);
  EXPECT_LT((found.F - expected.F).norm(), 1e-14);
  for (int i = 0; i < 3; ++i) EXPECT_LT((at(found.G, i) - at(expected.G, i)).norm(), 1e-13);
}

/// Compares positions, normals and curvatures of corresponding surface points of two bodies.
template <int D>
void expect_same_surface(const Geometry<D>& a, const Geometry<D>& b) {
  const SurfacePoints<D> p = surface_points(a, 3), q = surface_points(b, 3);
  ASSERT_EQ(p.size(), q.size());
  for (Index i = 0; i < p.size(); ++i) {
    EXPECT_LT((at(p.X, i) - at(q.X, i)).norm(), 1e-13);
    EXPECT_LT((at(p.N, i) - at(q.N, i)).norm(), 1e-13);
    EXPECT_LT((at(p.grad_N, i) - at(q.grad_N, i)).norm(), 1e-11);
    EXPECT_NEAR(at(p.area, i), at(q.area, i), 1e-13);
  }
  EXPECT_NEAR(volume(a.grid), volume(b.grid), 1e-12);
}

TEST(Placement, AStretchedBallIsAnEllipsoid) {
  const std::string cells = "core = 4\nlayers = 2\n";
  expect_same_surface<3>(
      test::geometry_of_lines<3>(
          "shape = 'ball'\nradius = 1\nmap = ['x', '1.5*y + 0.2', '0.7*z']\n" + cells),
      test::geometry_of_lines<3>(
          "shape = 'ellipsoid'\nsemi_axes = [1, 1.5, 0.7]\ncentre = [0, 0.2, 0]\n" + cells));
  expect_same_surface<2>(
      test::geometry_of_lines<2>(
          "shape = 'disk'\nradius = 1\ncore = 4\nrings = 2\nmap = ['2*x', 'y']"),
      test::geometry_of_lines<2>("shape = 'ellipse'\nsemi_axes = [2, 1]\ncore = 4\nrings = 2"));
}

TEST(Placement, IsTurnedAboutItsMiddleAndMoved) {
  const std::string box =
      "shape = 'box'\nsize = [1, 2, 3]\ncells = [1, 2, 3]\ncentre = [5, 0, 0]\n";
  const Geometry<3> turned =
      test::geometry_of_lines<3>(box + "rotate = 90\nrotate_axis = [1, 0, 0]\nmove = [0, 0, 7]");
  const Box<3> around = box_around<3>(turned.grid.X);
  EXPECT_LT((around.low - Vec<3>(4.5, -1.5, 6)).norm(), 1e-14);
  EXPECT_LT((around.high - Vec<3>(5.5, 1.5, 8)).norm(), 1e-14);
  expect_same_surface<2>(
      test::geometry_of_lines<2>(
          "shape = 'rectangle'\nsize = [2, 1]\ncells = [2, 1]\nrotate = '90 deg'"),
      test::geometry_of_lines<2>(
          "shape = 'rectangle'\nsize = [2, 1]\ncells = [2, 1]\nmap = ['-y', 'x']"));
}

TEST(Placement, WallsKeepTheirNormal) {
  const std::string shell =
      "shape = 'sphere_shell'\nradius = 2\nthickness = 0.4\nspacing = 0.6\nlayers = 3\n";
  const Geometry<3> plain = test::geometry_of_lines<3>(shell),
                    moved = test::geometry_of_lines<3>(shell + "rotate = 30\nmove = [9, 0, 0]"),
                    bent = test::geometry_of_lines<3>(shell + "map = ['x + 0.1*y^2', 'y', '2*z']");
  const Vec<3> X = Vec<3>(1, 1.2, 0.8).normalized() * 2;
  const Mat<3> turn =
      Eigen::AngleAxis<Real>(std::numbers::pi / 6, Vec<3>::UnitZ()).toRotationMatrix();
  EXPECT_LT((moved.director(turn * X + Vec<3>(9, 0, 0)) - turn * plain.director(X)).norm(), 1e-12);
  const Vec<3> x(X[0] + 0.1 * X[1] * X[1], X[1], 2 * X[2]);
  Mat<3> F = Mat<3>::Identity();
  F(0, 1) = 0.2 * X[1];
  F(2, 2) = 2;
  EXPECT_LT(
      (bent.director(x) - (inverse<3>(F).transpose() * plain.director(X)).normalized()).norm(),
      1e-12);
}

TEST(Placement, RefusesFolds) {
  const std::string ball = "shape = 'ball'\nradius = 1\ncore = 4\nlayers = 2\n";
  const std::string folded = problem<3>(ball + "map = ['x', 'y', 'z^3 - 0.5*z']");
  EXPECT_NE(folded.find("scene:6:"), std::string::npos) << folded;
  EXPECT_NE(folded.find("body.map: folds the body at x = "), std::string::npos) << folded;
  EXPECT_NE(folded.find("its Jacobian is -0.0"), std::string::npos) << folded;
  EXPECT_NE(problem<3>(ball + "map = ['x', 'y', '-z']").find("must be positive"),
            std::string::npos);
  EXPECT_NE(problem<3>(ball + "map = ['x', 'y', 'z + sqrt(x)']").find("is not finite"),
            std::string::npos);
  EXPECT_NE(problem<3>(ball + "map = ['x', 'y']").find("map"), std::string::npos);
  EXPECT_NE(problem<3>(ball + "map = ['x', 'y', 'z*t']").find("time t"), std::string::npos);
  EXPECT_NE(problem<3>(ball + "rotate = 3\nrotate_axis = [0, 0, 0]").find("rotate_axis: "),
            std::string::npos);
  EXPECT_NE(problem<3>(ball + "rotate_axis = [0, 0, 1]").find("without rotate"), std::string::npos);
}

}  // namespace
}  // namespace meniscus::test_placement
