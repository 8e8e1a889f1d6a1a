// SPDX-License-Identifier: BSD-3-Clause
// Enclosed volumes, exact gradients of fillings, balance of forces, and touching faces.
#include "body/surface/surface_patches.hpp"
#include "meniscus/error.hpp"
#include "physics/loads/cavity.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace meniscus::test_cavity {
namespace {

constexpr Real pi = std::numbers::pi;

/// A coarse hollow disk with bent axes: no symmetry.
Geometry<3> bent_shell() {
  DiskShell s;
  s.radius = 2;
  s.height = 1.6;
  s.thickness = 0.4;
  s.spacing = 0.6;
  const auto bend = smooth_map<3>([](const std::array<Jet<3>, 3>& X) {
    return std::array<Jet<3>, 3>{X[0] + 0.05 * X[1] * X[1], X[1], X[2] + 0.06 * X[0] * X[0]};
  });
  auto geometry = apply_map<3>(bend, s.geometry());
  return geometry;
}

/// A spherical shell of outer radius 1 and inner radius 0.75.
Geometry<3> sphere_shell(Real spacing) {
  SphereShell s;
  s.radius = 1;
  s.thickness = 0.25;
  s.spacing = spacing;
  return s.geometry();
}

Real measure(const ForceTerm& term, const std::string& name, const NodalVectors& u, Real time = 0) {
  const NodalVectors v = test::zeros(u);
  for (const MeasureSource& m : term.measures())
    if (m.name == name) return m.compute({time, u, v});
  throw std::runtime_error("no measure " + name);
}

template <int D>
void expect_exact_gradient(Geometry<D> geometry, SurfacePart part) {
  const auto body = test::body_of<D>(std::move(geometry));
  CavityFilling pressure, content;
  pressure.pressure = 0.8;
  content.volume_target = 0.7;
  content.penalty = 3;
  for (const CavityFilling& filling : {pressure, content}) {
    const auto term = cavity<D>(*body, part, filling, 2);
    for (unsigned seed = 0; seed < 3; ++seed) {
      const NodalVectors u = test::random_field<D>(body->size(), 0.03, seed);
      const NodalVectors direction = test::random_field<D>(body->size(), 1, 50 + seed);
      EXPECT_LT(test::gradient_error(*term, u, direction, 1e-3), 1e-8);
      const test::Balance net = test::balance_of<D>(*body, u, test::force_of(*term, u));
      EXPECT_LT(net.force, 1e-14);
      EXPECT_LT(net.torque, 1e-14);
    }
  }
}

TEST(Cavity, IsAnExactGradientWithoutNetForce) {
  expect_exact_gradient<3>(bent_shell(), SurfacePart::inner);
  expect_exact_gradient<3>(bent_shell(), SurfacePart::outer);
  expect_exact_gradient<3>(test::potato<3>(), SurfacePart::outer);
  expect_exact_gradient<2>(test::potato<2>(), SurfacePart::outer);
}

template <int D>
Real enclosed_after(const Body<D>& body, SurfacePart part, const NodalVectors& u) {
  return ClosedSurface<D>(body, part, 3).placed({0, u, test::zeros(u)}).size.volume;
}

TEST(Cavity, VolumesOfBallDiskAndShellAreExact) {
  const auto ball = test::body_of<3>(test::ball(4, 2));
  const auto disk = test::body_of<2>(test::disk(6, 3));
  SphereShell s;
  s.radius = 1;
  s.thickness = 0.25;
  s.spacing = 0.3;
  const auto hollow = test::body_of<3>(s.geometry());
  const auto stretched = [](const Body<3>& body) {
    return test::field_on<3>(body, [](const Vec<3>& X) { return Vec<3>(0, 0.5 * X[1], 0); });
  };
  EXPECT_NEAR(enclosed_after(*ball, SurfacePart::outer, stretched(*ball)), 1.5 * 4 * pi / 3, 1e-4);
  EXPECT_NEAR(enclosed_after(*hollow, SurfacePart::outer, stretched(*hollow)), 2 * pi, 1e-5);
  EXPECT_NEAR(enclosed_after(*hollow, SurfacePart::inner, stretched(*hollow)),
              2 * pi * std::pow(0.75, 3), 1e-5);
  const NodalVectors still(static_cast<std::size_t>(disk->size()), Lanes::zero());
  EXPECT_NEAR(enclosed_after(*disk, SurfacePart::outer, still), pi, 1e-6);
}

/// Errors of the volume of a unit ball after a shear that keeps its volume: with the points of the
/// cavity, and with the patches of surface tension.
std::array<Real, 2> errors_of_volume(int core) {
  const auto body = test::body_of<3>(test::ball(core, core / 2));
  const NodalVectors u = test::field_on<3>(
      *body, [](const Vec<3>& X) { return Vec<3>(0.2 * std::sin(2 * X[1]), 0, 0); });
  const SurfacePatches<3> patches(*body);
  const Real exact = 4 * pi / 3;
  return {std::abs(enclosed_after(*body, SurfacePart::outer, u) / exact - 1),
          std::abs(patches.measure(SurfacePatches<3>::Size::volume, u.data()) / exact - 1)};
}

TEST(Cavity, PointsEncloseMoreExactlyThanPatches) {
  const auto coarse = errors_of_volume(4), fine = errors_of_volume(8);
  for (const auto& [points, patches] : {coarse, fine}) EXPECT_LT(points, 0.2 * patches);
  for (const std::size_t k : {0U, 1U}) EXPECT_GT(std::log2(coarse[k] / fine[k]), 2.5) << k;
}

TEST(Cavity, PressureFollowsTheRamp) {
  const auto body = test::body_of<3>(bent_shell());
  const NodalVectors u(static_cast<std::size_t>(body->size()), Lanes::zero());
  CavityFilling filling;
  filling.volume_target = 0.7;
  filling.penalty = 10;
  filling.ramp = {1, 3};
  const auto term = cavity<3>(*body, SurfacePart::inner, filling, 3);
  EXPECT_EQ(term->steady_after(), 3);
  EXPECT_NEAR(measure(*term, "cavity_fraction", u), 1, 1e-14);
  EXPECT_NEAR(measure(*term, "cavity_pressure", u, 0.5), 0, 1e-13);
  EXPECT_NEAR(measure(*term, "cavity_pressure", u, 2), -10 * 0.15, 1e-12);
  EXPECT_NEAR(measure(*term, "cavity_pressure", u, 9), -10 * 0.3, 1e-12);
  // The work of the ramp is the change of the energy at a fixed motion.
  const Motion early{1.9, u, u}, late{2.1, u, u}, middle{2.0, u, u};
  NodalVectors force = u;
  const Real power = term->add_force(middle, force).external_power;
  EXPECT_NEAR(power, (*term->stored_energy(late) - *term->stored_energy(early)) / 0.2,
              0.01 * power);
  EXPECT_GT(power, 0);
}

TEST(Cavity, VentedDoesNothing) {
  const auto body = test::body_of<3>(bent_shell());
  const NodalVectors u = test::random_field<3>(body->size(), 0.01, 3);
  const auto term = cavity<3>(*body, SurfacePart::inner, {}, 3);
  EXPECT_EQ(test::norm(test::force_of(*term, u)), 0);
  EXPECT_FALSE(term->stored_energy({0, u, u}).has_value());
  EXPECT_EQ(term->steady_after(), 0);
}

TEST(Cavity, FacesThatTouchAreAFailure) {
  const auto body = test::body_of<3>(bent_shell());
  const auto term = cavity<3>(*body, SurfacePart::inner, {}, 3);
  const auto pressed = [&](Real share) {  // the inner faces are 0.8 apart
    return test::field_on<3>(*body, [&](const Vec<3>& X) {
      const Real height = X[2] - 0.06 * X[0] * X[0];
      return Vec<3>(0, 0,
                    -0.4 * share * std::tanh(6 * height) * std::exp(-X.head<2>().squaredNorm()));
    });
  };
  EXPECT_FALSE(test::report_of(*term, pressed(0.8)).failure.has_value());
  const auto failure = test::report_of(*term, pressed(1.3)).failure;
  ASSERT_TRUE(failure.has_value());
  EXPECT_NE(failure->cause.find("inner faces"), std::string::npos);
  const Vec<3>& X = at(body->particles.X(), failure->particle);
  EXPECT_LT(X.head<2>().norm(), 0.7);
}

TEST(Cavity, GapIsTheDistanceOfTheFaces) {
  const auto body = test::body_of<3>(sphere_shell(0.4));
  const auto term = cavity<3>(*body, SurfacePart::inner, {}, 3);
  const auto flattened = [&](Real share) {
    return test::field_on<3>(*body, [&](const Vec<3>& X) { return Vec<3>(0, 0, -share * X[2]); });
  };
  EXPECT_NEAR(measure(*term, "cavity_gap", flattened(0)), 1.5, 0.01);
  EXPECT_NEAR(measure(*term, "cavity_gap", flattened(0.4)), 0.9, 0.03);  // facets are coarse
}

TEST(Cavity, GapIsFoundWhereverTheFacesComeNear) {
  const auto body = test::body_of<3>(sphere_shell(0.2));
  const auto term = cavity<3>(*body, SurfacePart::inner, {}, 3);
  // A dent r(angle) of the inner radius R; the opposite face is unchanged. Along the normal of the
  // dent the width is (R + r) r / (r^2 + r'^2)^(1/2), least on its flank.
  constexpr Real R = 0.75, depth = 0.3, square = 0.6;
  Real width = unbounded;
  for (Real angle = 0; angle < 1; angle += 1e-3) {
    const Real there = depth * std::exp(-(2 - 2 * std::cos(angle)) / square), r = R * (1 - there),
               slope = R * there * 2 * std::sin(angle) / square;
    width = std::min(width, (R + r) * r / std::hypot(r, slope));
  }
  for (int dent = 0; dent < 12; ++dent) {
    const Vec<3> way =
        Vec<3>(std::cos(2.4 * dent), std::sin(2.4 * dent), 0.15 * dent - 0.9).normalized();
    const NodalVectors u = test::field_on<3>(*body, [&](const Vec<3>& X) {
      return Vec<3>(-depth * std::exp(-(X.normalized() - way).squaredNorm() / square) * X);
    });
    EXPECT_NEAR(measure(*term, "cavity_gap", u), width, 0.02) << way.transpose();
  }
}

TEST(Cavity, SolidBodyHasNoInnerSurface) {
  const auto body = test::body_of<3>(test::ball(3, 2));
  EXPECT_THROW_WITH(cavity<3>(*body, SurfacePart::inner, {}, 3), InputError, "inner surface");
}

}  // namespace
}  // namespace meniscus::test_cavity
