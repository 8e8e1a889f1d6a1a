// SPDX-License-Identifier: BSD-3-Clause
// Shape measures of cells on known shapes.
#include "measure/cell_measures.hpp"
#include "measure/meridian_shape.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace meniscus::test_cell_measures {
namespace {

DiskShell flat_cell(Real spacing) {
  DiskShell s;
  s.radius = 5;
  s.height = 3;
  s.thickness = 0.5;
  s.spacing = spacing;
  return s;
}

class CellMeasures : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    body = test::body_of<3>(flat_cell(0.49).geometry());
    measures = cell_measures(*body, UnitSystem("um-s-ng"));
  }
  static void TearDownTestSuite() {
    measures.clear();
    body.reset();
  }
  static Real measure(const std::string& name, const NodalVectors& u) {
    const NodalVectors v = test::zeros(u);
    for (const MeasureSource& m : measures)
      if (m.name == name) return m.compute({0, u, v});
    throw std::runtime_error("no measure " + name);
  }
  static inline std::unique_ptr<Body<3>> body;
  static inline std::vector<MeasureSource> measures;
};

TEST_F(CellMeasures, OfTheReferenceShape) {
  const NodalVectors rest(static_cast<std::size_t>(body->size()), Lanes::zero());
  EXPECT_NEAR(measure("diameter", rest), 10, 1e-4);
  EXPECT_NEAR(measure("pole_thickness", rest), 3, 1e-9);
  EXPECT_NEAR(measure("largest_thickness", rest), 3, 1e-9);
  EXPECT_NEAR(measure("thickness_ratio", rest), 1, 1e-9);
  EXPECT_NEAR(measure("asymmetry", rest), 0, 1e-9);
  EXPECT_NEAR(measure("rim_spread", rest), 0, 1e-9);
  EXPECT_NEAR(measure("outer_area", rest), 208.87419, 0.05);
  EXPECT_NEAR(measure("outer_volume", rest), 207.31380, 0.1);
  EXPECT_NEAR(measure("reduced_volume", rest), 0.7303436, 5e-4);
  EXPECT_NEAR(measure("evans_fung_rms", rest), 0.79155, 0.005);
}

/// A stretch of the reference into a shape with a dimple, rotated and translated.
Vec<3> dimpled(const Vec<3>& X) {
  const Real s = X.head<2>().squaredNorm() / 25;
  return {1.1 * X[0], 1.1 * X[1], X[2] * (0.4 + 1.2 * s - 0.5 * s * s)};
}

TEST_F(CellMeasures, DoNotDependOnAMotionOfTheWholeCell) {
  const Mat<3> Q = Eigen::AngleAxisd(1.1, Vec<3>(1, 2, -0.5).normalized()).toRotationMatrix();
  const auto still =
      test::field_on<3>(*body, [](const Vec<3>& X) -> Vec<3> { return dimpled(X) - X; });
  const auto moved = test::field_on<3>(
      *body, [&](const Vec<3>& X) -> Vec<3> { return Q * dimpled(X) + Vec<3>(7, -3, 2) - X; });
  for (const MeasureSource& m : measures)
    EXPECT_NEAR(measure(m.name, moved), measure(m.name, still), 1e-9) << m.name;
  EXPECT_NEAR(measure("diameter", still), 11, 1e-3);
  EXPECT_NEAR(measure("pole_thickness", still), 1.2, 5e-3);
  EXPECT_LT(measure("asymmetry", still), 1e-9);
}

TEST_F(CellMeasures, SeeOneSidedAndUnroundCells) {
  const auto bowl = test::field_on<3>(
      *body, [](const Vec<3>& X) { return Vec<3>(0, 0, 0.3 * X.head<2>().squaredNorm() / 25); });
  EXPECT_NEAR(measure("asymmetry", bowl), 0.3 * 0.95 * 0.95 / 3, 2e-3);
  const auto oval = test::field_on<3>(
      *body, [](const Vec<3>& X) { return Vec<3>(0.05 * X[0], -0.05 * X[1], 0); });
  EXPECT_NEAR(measure("rim_spread", oval), 0.05 / std::sqrt(2.0), 1e-3);
}

TEST_F(CellMeasures, ProfileAgainstItself) {
  std::vector<Real> r, z, shifted;
  for (int k = 0; k <= 20; ++k) {
    const Real s = 5.856 * k / 20, psi = (s - 3.5) / 1.5;
    r.push_back(s < 3.5 ? s : 3.5 + 1.5 * std::sin(psi));
    z.push_back(s < 3.5 ? 1.5 : 1.5 * std::cos(psi));
  }
  const NodalVectors rest(static_cast<std::size_t>(body->size()), Lanes::zero());
  EXPECT_LT(profile_rms(*body, r, z).compute({0, rest, rest}), 5e-4);
  EXPECT_NEAR(profile_rms(*body, {0, 1, 2}, {1.6, 1.6, 1.6}).compute({0, rest, rest}), 0.1, 1e-9);
}

TEST(EvansFung, HasTheNumbersOfItsCoefficients) {
  EXPECT_NEAR(evans_fung_thickness(0), 0.81, 1e-15);
  EXPECT_NEAR(evans_fung_thickness(0.7002), 2.5657, 1e-4);
  EXPECT_EQ(evans_fung_thickness(1), 0);
  // The volume is 2 pi int t r dr with R = 3.91.
  Real V = 0;
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k) {
    const Real x = (k + 0.5) / n;
    V += 2 * std::numbers::pi * 3.91 * 3.91 * evans_fung_thickness(x) * x / n;
  }
  EXPECT_NEAR(V, 94.091, 1e-3);
}

TEST(EvansFung, SolidBodiesHaveNoCellMeasures) {
  const auto ball = test::body_of<3>(test::ball(3, 2));
  EXPECT_TRUE(cell_measures(*ball, UnitSystem()).empty());
}

}  // namespace
}  // namespace meniscus::test_cell_measures
