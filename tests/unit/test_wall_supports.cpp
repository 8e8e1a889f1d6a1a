// SPDX-License-Identifier: BSD-3-Clause
// Kernels of shells stay inside the wall; the stiffness if they do not.
#include "body/surface/surface_points.hpp"
#include "body/wall_supports.hpp"
#include "meniscus/error.hpp"
#include "physics/loads/cavity.hpp"
#include "solve/step/central_difference.hpp"
#include "solve/step/relaxation.hpp"
#include "solve/step/step_controller.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace meniscus::test_wall_supports {
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
  return {geometry.grid.X, test::Support<3>{}, KernelFunction::cubic_spline};
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

/// Share of the particles whose kernels reach the other side of the cavity.
Real crossing_kernels(const ParticleSet<3>& particles, const Geometry<3>& geometry) {
  const auto inner = surface_points(geometry, 3, SurfacePart::inner);
  Index count = 0;
  for (Index A = 0; A < particles.size(); ++A) {
    const Vec<3>&X = at(particles.X(), A), normal = geometry.director(X);
    bool crosses = false;
    for (Index q = 0; q < inner.size() && !crosses; ++q)
      crosses = (at(inner.X, q) - X).norm() < at(particles.support(), A) &&
                normal.dot(at(inner.N, q)) > 0.77;
    count += crosses;
  }
  return Real(count) / particles.size();
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
  ParticleSet<3> particles{geometry.grid.X, {1.2, 8}, KernelFunction::cubic_spline};
  keep_supports_in_wall(particles, geometry);
  EXPECT_GT(particles.ensure_quality(geometry.grid.X, "cell"), 0);
  EXPECT_EQ(couplings_across(particles, geometry), 0);
}

TEST(WallSupports, SolidBodiesKeepTheirs) {
  const Geometry<3> ball = test::ball(4, 2);
  ParticleSet<3> particles = default_supports(ball);
  EXPECT_EQ(keep_supports_in_wall(particles, ball).shortened, 0);
}

/// The hollow disk of red blood cell note 9, deflated to about 0.72 of its cavity.
struct Deflated {
  Real crossing = 0;  ///< share of the kernels that reach across the cavity
  Real energy = 0;    ///< of strain, over that of finite elements at the same enclosed volume
};

/// Red blood cell note 4: energies at 0.7, 0.72 and 0.74 of the volume of the cavity, interpolated.
Real finite_element_energy(Real fraction) {
  const Real x = (fraction - 0.72) / 0.02;
  return 429.39556 + x * (372.39071 - 490.54635) / 2 +
         x * x * (372.39071 + 490.54635 - 2 * 429.39556) / 2;
}

Deflated deflated(bool in_wall) {
  System<3> system;
  Geometry<3> geometry = flat_cell(0.977);
  ParticleSet<3> particles{geometry.grid.X, 2.4, KernelFunction::cubic_spline};
  if (in_wall) keep_supports_in_wall(particles, geometry);
  particles.ensure_quality(geometry.grid.X, "cell");
  Body<3>& body = system.bodies.emplace_back("cell", std::move(geometry), std::move(particles));
  system.terms.push_back(test::internal_force<3>(
      body, "liquid_crystal_elastomer",
      "# reference_director: by default the normals of the wall\ndensity = 1000\nmu = 1e4\n"
      "bulk_modulus = 1e5\nvolume_energy = \"logarithmic\"\nstep_length = 2\n",
      {"q_scni", 0, "full"}));
  CavityFilling filling;
  filling.volume_target = 0.7;
  filling.penalty = 4000;
  filling.ramp = {0, 6};
  system.terms.push_back(cavity<3>(body, SurfacePart::inner, filling, 2));
  system.mass = body.mass;

  State state;
  state.u.assign(system.mass.size(), Lanes::zero());
  state.v = state.force = state.u;
  start(system, state);
  StepController<3> controller(system, {.fixed = {}, .safety = 0.9});
  controller.begin(state);
  Relaxation<3> relaxation(system, {1, 1});
  relaxation.begin(state);
  while (state.time < 9) {
    const Real dt = controller.next(state, 9);
    relaxation.step(state, dt);
  }

  const ClosedSurface<3> inner(body, SurfacePart::inner, 2);
  const NodalVectors still(state.u.size(), Lanes::zero());
  const Real reference = inner.placed({0, still, still}).size.volume;
  Deflated result;
  result.energy = *system.terms.front()->stored_energy(state.motion()) /
                  finite_element_energy(inner.placed(state.motion()).size.volume / reference);
  result.crossing = crossing_kernels(body.particles, body.geometry);
  return result;
}

// Red blood cell note 7 found 2.6 times the energy with 60 % of the kernels crossing, also with 872
// particles, but with nodal integration and unknown supports.
TEST(WallSupports, KernelsAcrossTheCavityMakeItFarTooStiff) {
  const Deflated crossing = deflated(false), within = deflated(true);
  EXPECT_NEAR(crossing.crossing, 0.6, 0.06);
  EXPECT_GT(crossing.energy, 2.6);
  EXPECT_EQ(within.crossing, 0);
  EXPECT_NEAR(within.energy, 1.17, 0.1);
}

/// A shape with a cavity whose maker has forgotten the normal of its walls.
TEST(WallSupports, NeedTheNormalOfTheWalls) {
  Geometry<3> geometry = flat_cell(1);
  ParticleSet<3> particles = default_supports(geometry);
  geometry.director = {};
  EXPECT_THROW_WITH(keep_supports_in_wall(particles, geometry), InputError, "normal");
}

}  // namespace
}  // namespace meniscus::test_wall_supports
