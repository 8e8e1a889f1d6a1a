// SPDX-License-Identifier: BSD-3-Clause
// The artificial inertia of thin bodies in relaxation is symmetric and positive, allows long steps,
// and leads to known states.
#include "run/simulation.hpp"
#include "solve/step/elastic_inertia.hpp"
#include "solve/step/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meniscus::test_elastic_inertia {
namespace {

/// A plate whose thickness is a sixteenth of its sides.
std::string plate(const std::string& material, const std::string& more = "",
                  const std::string& size = "[4, 4, 0.25]",
                  const std::string& cells = "[6, 6, 3]") {
  return "dimension = 3\n[time]\nsolver = \"relax\"\nend = 2000\nforce_tolerance = 1e-8\n"
         "shape_tolerance = 1e-7\n[[body]]\nname = \"plate\"\nshape = \"box\"\nsize = " +
         size + "\ncells = " + cells + "\n" + more + "[body.material]\n" + material;
}

const std::string rubber = "type = \"neo_hookean\"\ndensity = 1\nmu = 1.25\nlambda = 5\n";
const std::string active =
    "type = \"liquid_crystal_elastomer\"\ndensity = 1\nmu = 1.25\nbulk_modulus = 8\n"
    "step_length = 2.5\nreference_director = [0, 0, 1]\nactivity = 0.4439517925290134\n"
    "activity_ramp = [0, 5]\n";

struct Relaxed {
  Scene<3> scene;
  Simulation<3> simulation;

  explicit Relaxed(const std::string& text) : scene(read(text)), simulation(scene) {
    simulation.begin();
  }
  static Scene<3> read(const std::string& text) {
    const SceneInput input = SceneInput::from_text(text);
    scene_dimension(input);
    return build_scene<3>(input);
  }
  void go() {
    while (!simulation.finished()) {
      simulation.advance();
      simulation.audit_now();
    }
    EXPECT_TRUE(simulation.stepper().arrived());
  }
  Real measure(const std::string& name) const {
    for (const MeasureSource& m : scene.measures)
      if (m.name == name) return m.compute(simulation.state().motion());
    throw std::logic_error(name);
  }
};

NodalVectors noise(Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> between(-1, 1);
  NodalVectors w(static_cast<std::size_t>(n));
  for (NodalVector& x : w) x = Lanes(between(random), between(random), between(random), 0);
  return w;
}

Real product(const NodalVectors& a, const NodalVectors& b) {
  Real all = 0;
  for (std::size_t A = 0; A < a.size(); ++A) all += sum(a[A] * b[A]);
  return all;
}

TEST(ElasticInertia, IsSymmetricAndPositive) {
  Scene<3> scene = Relaxed::read(plate(rubber));
  const ElasticInertia<3> inertia(scene.system);
  const NodalVectors a = noise(scene.system.size(), 1), b = noise(scene.system.size(), 2);
  NodalVectors x, y;
  inertia.solve(a, x);
  inertia.solve(b, y);
  const Real size = std::sqrt(product(a, x) * product(b, y));
  EXPECT_GT(product(a, x), 0);
  EXPECT_NEAR(product(a, y), product(b, x), 1e-12 * size);
}

/// Under forces proportional to its masses, a body is accelerated as a whole in their direction, as
/// if it had half of its mass.
TEST(ElasticInertia, UniformForcesMoveBodiesAsAWhole) {
  Scene<3> scene = Relaxed::read(plate(rubber));
  const ElasticInertia<3> inertia(scene.system);
  const Body<3>& body = scene.system.bodies.front();
  NodalVectors r(scene.system.mass.size(), Lanes::zero()), z;
  // Forces m at the places of the particles, transferred to the coefficients by T^t.
  for (Index A = 0; A < body.size(); ++A) {
    const PointRows<3>& rows = body.at_particles;
    for (Offset e = at(rows.start, A); e < at(rows.start, A + 1); ++e)
      at(r, at(rows.particle, e)) += Lanes(at(rows.value, e) * at(scene.system.mass, A), 0, 0, 0);
  }
  inertia.solve(r, z);
  Real least = unbounded, most = 0;
  for (const NodalVector& v : z) {
    EXPECT_EQ(v[1], 0);
    least = std::min(least, v[0]);
    most = std::max(most, v[0]);
  }
  EXPECT_NEAR(0.5 * (least + most), 2, 0.1);
  EXPECT_LT(most - least, 0.3);
}

TEST(ElasticInertia, AllowsLongSteps) {
  Relaxed run(plate(rubber));
  EXPECT_TRUE(run.simulation.stepper().chooses_step());
  const ElasticInertia<3> inertia(run.scene.system);
  ElasticStep<3> step(run.scene.system, 1);
  const Real by_masses =
      StableStepEstimator<3>(run.scene.system).estimate(run.simulation.state()).dt;
  const Real dt = step.at_state(inertia, run.simulation.state());
  EXPECT_GT(dt, 4 * by_masses);
  // The stable step is at most 2 over the frequency of any motion.
  const NodalVectors still(run.scene.system.mass.size(), Lanes::zero());
  for (unsigned seed = 1; seed < 6; ++seed) {
    const NodalVectors r = noise(run.scene.system.size(), seed);
    NodalVectors w, Kw = still;
    inertia.solve(r, w);
    for (auto& term : run.scene.system.terms)
      term->add_tangent({0, still, still}, {0, w, still}, Kw);
    EXPECT_LT(-product(w, Kw) / product(w, r), 4 / (dt * dt));
  }
}

TEST(ElasticInertia, IsForThinElasticBodiesAlone) {
  const auto chooses = [](const std::string& text) {
    return Relaxed(text).simulation.stepper().chooses_step();
  };
  EXPECT_TRUE(chooses(plate(active)));
  EXPECT_FALSE(chooses(plate(rubber, "", "[4, 4, 2]", "[4, 4, 2]")));
  EXPECT_FALSE(chooses(plate(rubber) + "[[held]]\nbody = \"plate\"\nface = \"x_min\"\n"));
  EXPECT_FALSE(
      chooses(plate("type = \"newtonian\"\ndensity = 1\nbulk_modulus = 20\nviscosity = 0.3\n")));
  std::string with_step = plate(rubber);
  with_step.replace(with_step.find("end = 2000"), 10, "end = 2000\nstep = 1e-3");
  EXPECT_FALSE(chooses(with_step));
}

TEST(ElasticInertia, ActivePlateReachesItsStretches) {
  Relaxed run(plate(active));
  run.go();
  EXPECT_GT(run.simulation.state().time, 5);
  EXPECT_NEAR(run.measure("plate.extent_z") / 0.25, 1.1222250670561522, 1e-6);
  EXPECT_NEAR(run.measure("plate.extent_x") / 4, 0.9509088637224783, 1e-6);
  const Ledger ledger = run.simulation.audit_now();
  EXPECT_LT(std::abs(run.simulation.audit().balance_error(ledger)), 1e-3);
  EXPECT_LT(run.simulation.audit().momentum_error(ledger), 1e-10);
}

/// Bending is the slowest motion of a plate. The residual is not small relative to the forces
/// before they cancel, since these vanish, too.
TEST(ElasticInertia, BentPlateBecomesFlat) {
  std::string text = plate(rubber, "initial_displacement = [0, 0, \"0.05*x^2 - 0.03*x*y\"]\n");
  text.replace(text.find("1e-8"), 4, "0.02");
  Relaxed run(text);
  const Real height = run.measure("plate.extent_z");
  run.go();
  EXPECT_GT(height, 0.4);
  EXPECT_NEAR(run.measure("plate.extent_z"), 0.25, 1e-5);
  EXPECT_LT(run.simulation.state().step, 2500);
}

TEST(ElasticInertia, BeginsAtRest) {
  Relaxed run(plate(rubber, "initial_velocity = [\"0.01*y\", 0.01, 0]\n"));
  run.go();
  const Ledger ledger = run.simulation.audit_now();
  EXPECT_GT(ledger.dissipated, 1e-4);
  EXPECT_LT(std::abs(run.simulation.audit().balance_error(ledger)), 1e-12);
}

TEST(ElasticInertia, GoesOnFromASnapshotWithTheSameBits) {
  Relaxed straight(plate(active)), broken(plate(active));
  for (int n = 0; n < 45; ++n) straight.simulation.advance();
  const Snapshot snapshot = straight.simulation.snapshot();
  broken.simulation.restore(snapshot);
  EXPECT_EQ(broken.simulation.snapshot().hash(), snapshot.hash());
  for (int n = 0; n < 45; ++n) {
    straight.simulation.advance();
    broken.simulation.advance();
  }
  EXPECT_EQ(broken.simulation.snapshot().hash(), straight.simulation.snapshot().hash());
}

}  // namespace
}  // namespace meniscus::test_elastic_inertia
