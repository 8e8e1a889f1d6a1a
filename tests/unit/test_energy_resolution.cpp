// SPDX-License-Identifier: BSD-3-Clause
// The step resolves the exchange of energy after a sudden release, and leaves smooth motion alone.
#include "meniscus/scene/simulation.hpp"
#include "meniscus/solve/energy_resolution.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace meniscus::test_energy_resolution {
namespace {

std::string bar(const std::string& keys, double end) {
  return "dimension = 2\ntime = { end = " + std::to_string(end) +
         " }\n[[body]]\nname = \"bar\"\nshape = \"rectangle\"\nsize = [4, 1]\ncells = [16, 4]\n" +
         keys +
         "\nmaterial = { type = \"st_venant_kirchhoff\", density = 1, mu = 0.4, lambda = 0.6 }\n";
}
const std::string let_go = "initial_displacement = [\"0.1*x\", \"0\"]";
const std::string translation = "initial_velocity = [\"0.3\", \"0.1\"]";
/// The slowest bending of a free bar, nearly.
const std::string bending = "initial_velocity = [\"0\", \"1e-3*cos(4.73*x/4)\"]";

struct Outcome {
  Real balance = 0;  ///< largest error of the balance of energy
  int steps = 0, shortened = 0, changes = 0;
};

Outcome run(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  Scene<2> scene = build_scene<2>(input);
  Simulation<2> simulation(scene);
  simulation.begin();
  Outcome outcome;
  Real before = 0;
  while (!simulation.finished()) {
    simulation.advance();
    const Ledger ledger = simulation.audit_now();
    outcome.balance = std::max(outcome.balance, std::abs(simulation.audit().balance_error(ledger)));
    const Real dt = simulation.last_step();
    ++outcome.steps;
    outcome.shortened += dt < 0.85 * simulation.controller().stable().dt;
    outcome.changes += std::abs(dt / before - 1) > 1e-12;
    before = dt;
  }
  return outcome;
}

TEST(EnergyResolution, KeepsTheBalanceAfterASuddenRelease) {
  const Outcome outcome = run(bar(let_go, 20));
  EXPECT_LT(outcome.balance, 1e-2);
  EXPECT_GT(outcome.shortened, 20);
  // A step that followed every oscillation would make the energy drift.
  EXPECT_LT(outcome.changes, outcome.steps / 8);
}

TEST(EnergyResolution, LeavesSmoothMotionItsStableStep) {
  for (const std::string& motion : {translation, bending}) {
    const Outcome outcome = run(bar(motion, 40));
    EXPECT_LE(outcome.shortened, 2) << motion;  // the last two, which fit the end
    EXPECT_LT(outcome.balance, 1e-2) << motion;
  }
}

TEST(EnergyResolution, IsThatOfAnOscillator) {
  // One degree of freedom at rest at x = a: S = k^2 x^2/m, no energy in motion, then all of it.
  System<2> system;
  system.mass = {2.0};
  State state;
  state.u = state.v = state.force = NodalVectors(1, Lanes::zero());
  const Real k = 3, a = 0.1;
  state.force[0].set(0, -k * a);
  EnergyResolution<2> resolution;
  EXPECT_EQ(resolution.longest_step(system, state), 0);
  state.step = 5;
  state.v[0].set(0, 0.2);
  state.force[0].set(0, -k * 0.05);
  const Real eta = 5e-3, E = 0.5 * 2.0 * 0.04, S = 0.15 * 0.15 / 2.0;
  EXPECT_NEAR(resolution.longest_step(system, state), 0.8 * std::sqrt(8 * eta * E / S), 1e-12);
}

}  // namespace
}  // namespace meniscus::test_energy_resolution
