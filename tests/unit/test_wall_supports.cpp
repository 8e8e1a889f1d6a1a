// SPDX-License-Identifier: BSD-3-Clause
// Kernels of shells stay inside the wall, and what it costs when they do not.
#include "meniscus/body/surface_points.hpp"
#include "meniscus/body/wall_supports.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support.hpp"

namespace meniscus {
namespace {

Geometry<3> flat_cell(Real spacing, Real thickness = 0.5) {
  DiskShell s;
  s.radius = 5;
  s.height = 3;
  s.thickness = thickness;
  s.spacing = spacing;
  Geometry<3> geometry = s.geometry();
  order_spatially(geometry);
  return geometry;
}

ParticleSet<3> default_supports(const Geometry<3>& geometry) {
  return {geometry.grid.X, test::Support<3>{}, Window::cubic_spline};
}

/// Pairs (surface point, particle on the other side of the cavity) that a kernel couples.
Index couplings_across(const ParticleSet<3>& particles, const Geometry<3>& geometry) {
  const auto inner = surface_points(geometry, 2, SurfacePart::inner);
  Index count = 0;
  std::vector<Candidate<3>> found;
  for (Index q = 0; q < inner.size(); ++q) {
    particles.candidates(at(inner.X, q), 0, found);
    for (const auto& candidate : found)
      count += geometry.director(candidate.X).dot(at(inner.N, q)) > 0.77;  // 140 degrees
  }
  return count;
}

TEST(WallSupports, EndBeforeTheOtherSide) {
  for (const Real spacing : {1.0, 0.49}) {
    const Geometry<3> geometry = flat_cell(spacing);
    ParticleSet<3> particles = default_supports(geometry);
    const Index before = couplings_across(particles, geometry);
    const WallReport report = keep_supports_in_wall(particles, geometry);
    EXPECT_EQ(couplings_across(particles, geometry), 0);
    EXPECT_EQ(before > 0, spacing == 1.0);
    EXPECT_EQ(report.shortened > 0, spacing == 1.0);
    EXPECT_EQ(report.least_share < 0.9, spacing == 1.0);
  }
}

TEST(WallSupports, AreNotEnlargedAcrossTheCavity) {
  const Geometry<3> geometry = flat_cell(1.2, 1.0);  // particles farther apart than the sides
  ParticleSet<3> particles{geometry.grid.X, {1.2, 8}, Window::cubic_spline};
  keep_supports_in_wall(particles, geometry);
  EXPECT_GT(particles.ensure_quality(geometry.grid.X, "cell"), 0);
  EXPECT_EQ(couplings_across(particles, geometry), 0);
}

TEST(WallSupports, SolidBodiesKeepTheirs) {
  const Geometry<3> ball = test::ball(4, 2);
  ParticleSet<3> particles = default_supports(ball);
  EXPECT_EQ(keep_supports_in_wall(particles, ball).shortened, 0);
}

/// Strain energy of faces that approach each other with a smooth dent.
Real dent_energy(Real spacing, Real thickness, bool in_wall) {
  Geometry<3> geometry = flat_cell(spacing, thickness);
  ParticleSet<3> particles = default_supports(geometry);
  if (in_wall) keep_supports_in_wall(particles, geometry);
  particles.ensure_quality(geometry.grid.X, "cell");
  Body<3> body("cell", std::move(geometry), std::move(particles));
  body.at_particles =
      build_point_rows<3>(body.particles, body.particles.X(), {.value = true}, body.name);
  const auto term = test::internal_force<3>(body, "neo_hookean");
  const NodalVectors u = test::field_on<3>(body, [&](const Vec<3>& X) {
    const Real x = X.head<2>().norm() / 3.5, dent = x < 1 ? 0.01 * std::pow(1 - x * x, 3) : 0;
    return Vec<3>(0, 0, X[2] > 0 ? -dent : dent);
  });
  return test::energy_of(*term, u);
}

TEST(WallSupports, KernelsAcrossTheCavityMakeItFarTooStiff) {
  const Real exact = 2.819e-4;  // with spacings of 0.3 and 0.37
  EXPECT_NEAR(dent_energy(0.9, 1.0, true), exact, 0.03 * exact);
  EXPECT_GT(dent_energy(0.9, 1.0, false), 1.7 * exact);
}

}  // namespace
}  // namespace meniscus
