// SPDX-License-Identifier: BSD-3-Clause
// Lumped masses keep mass, first and second moments of the body if some masses are raised to the
// floor.
#include "support.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_lumped_mass {
namespace {

/// Mass, first and second moments about the origin.
template <int D>
struct Moments {
  Real mass = 0;
  Vec<D> first = Vec<D>::Zero();
  Mat<D> second = Mat<D>::Zero();

  void add(Real m, const Vec<D>& X) {
    mass += m;
    first += m * X;
    second += m * X * X.transpose();
  }
};

template <int D>
void expect_moments_of_the_volume(Geometry<D> geometry, bool floor_acts) {
  const auto body = test::body_of<D>(std::move(geometry));
  const Real rho = 2.5;
  const std::vector<Real> density(static_cast<std::size_t>(body->size()), rho);
  const MassReport report = lump_mass(*body, density, shape_integrals(*body));
  EXPECT_EQ(report.raised > 0, floor_acts);
  EXPECT_EQ(report.kept_degree, 2);
  EXPECT_EQ(report.added, 0);

  Moments<D> volume, lumped;
  for (Index A = 0; A < body->size(); ++A) {
    const Real m = rho * body->cells.volume(A);
    volume.add(m, body->cells.centroid(A));
    volume.second += m * body->cells.covariance(A);
    lumped.add(at(body->mass, A), at(body->particles.X(), A));
    EXPECT_GE(at(body->mass, A), 0.3 * m * (1 - 1e-12)) << "particle " << A;
  }
  const Real scale = volume.second.trace();
  EXPECT_NEAR(lumped.mass, volume.mass, 1e-10 * volume.mass);
  EXPECT_LE((lumped.first - volume.first).norm(), 1e-10 * std::sqrt(scale * volume.mass));
  EXPECT_LE((lumped.second - volume.second).norm(), 1e-9 * scale);
}

TEST(LumpedMass, HasTheMomentsOfABox) {
  expect_moments_of_the_volume<3>(test::brick<3>({4, 4, 4}), true);
  expect_moments_of_the_volume<3>(test::brick<3>({10, 10, 10}), true);
}
TEST(LumpedMass, HasTheMomentsOfAJitteredBox) {
  expect_moments_of_the_volume<3>(test::brick<3>({6, 4, 5}, 0.3), true);
}
TEST(LumpedMass, HasTheMomentsOfARectangle) {
  expect_moments_of_the_volume<2>(test::brick<2>({12, 5}), true);
  expect_moments_of_the_volume<2>(test::brick<2>({12, 5}, 0.3), true);
}
TEST(LumpedMass, HasTheMomentsOfABallWithoutAFloor) {
  expect_moments_of_the_volume<3>(test::ball(6, 3), false);
}
TEST(LumpedMass, HasTheMomentsOfAHalfSphere) {
  HalfSphere half;
  half.core = 6;
  half.layers = 3;
  expect_moments_of_the_volume<3>(half.geometry(), true);
}
TEST(LumpedMass, HasTheMomentsOfACylinder) {
  Cylinder cylinder;
  cylinder.core = 6;
  cylinder.rings = 3;
  cylinder.height = 2;
  cylinder.layers = 8;
  expect_moments_of_the_volume<3>(cylinder.geometry(), true);
}

TEST(LumpedMass, TakesFromNeighboursWhatTheFloorAdds) {
  const auto body = test::body_of<2>(test::disk(12, 6));
  std::vector<Real> integral = shape_integrals(*body);
  const std::vector<Real> density(integral.size(), 3.0);
  const std::vector<Real> untouched = integral;
  integral[5] = -0.1 * body->cells.volume(5);
  const MassReport report = lump_mass(*body, density, integral);
  EXPECT_EQ(report.raised, 1);
  EXPECT_DOUBLE_EQ(body->mass[5], 0.9 * body->cells.volume(5));
  Real sum = 0, wanted = 0;
  Index changed = 0;
  for (Index A = 0; A < body->size(); ++A) {
    sum += at(body->mass, A);
    wanted += 3 * at(integral, A);
    changed += at(body->mass, A) != 3 * at(integral, A);
  }
  EXPECT_NEAR(sum, wanted, 1e-13 * wanted);
  EXPECT_LT(changed, body->size() / 2);
}

TEST(LumpedMass, SaysHowMuchItAddedWhereNobodyCanGive) {
  const auto body = test::body_of<2>(test::brick<2>({2, 2}));
  const std::vector<Real> density(static_cast<std::size_t>(body->size()), 1.0);
  std::vector<Real> integral(density.size());
  for (Index A = 0; A < body->size(); ++A) at(integral, A) = 0.25 * body->cells.volume(A);
  const MassReport report = lump_mass(*body, density, integral);
  EXPECT_LT(report.kept_degree, 0);
  EXPECT_NEAR(report.added, 0.2, 1e-12);
}

}  // namespace
}  // namespace meniscus::test_lumped_mass
