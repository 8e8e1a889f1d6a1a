// SPDX-License-Identifier: BSD-3-Clause
// After a sudden release, the step resolves the exchange of energy. In smooth motion the step is
// the stable step.
#include "meniscus/error.hpp"
#include "run/simulation.hpp"
#include "solve/step/energy_resolution.hpp"

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
/// About the slowest bending of a free bar.
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
  // If the step followed every oscillation, the energy would drift.
  EXPECT_LT(outcome.changes, outcome.steps / 8);
}

TEST(EnergyResolution, LeavesSmoothMotionItsStableStep) {
  for (const std::string& motion : {translation, bending}) {
    const Outcome outcome = run(bar(motion, 40));
    EXPECT_LE(outcome.shortened, 3) << motion;  // the first, and the last two, which fit the end
    EXPECT_LT(outcome.balance, 1e-2) << motion;
  }
}

TEST(EnergyResolution, KnowsWhatASwirlWillExchangeBeforeItDoes) {
  // Nothing is strained at the start, so S = 0. A step limited by S alone would leave an error of
  // 1.1e-2.
  const Outcome outcome =
      run(bar("jitter = 0.4\ninitial_velocity = [\"0.02*sin(pi*x)*cos(pi*y)\", "
              "\"-0.02*cos(pi*x)*sin(pi*y)\"]",
              10));
  EXPECT_LT(outcome.balance, 7e-3);
  EXPECT_LT(outcome.changes, outcome.steps / 8);
}

/// One degree of freedom: m x'' = -k x.
struct Oscillator {
  static constexpr Real k = 3, m = 2, a = 0.1;
  System<2> system;
  State state;
  Oscillator() {
    system.mass = {m};
    state.u = state.v = state.force = NodalVectors(1, Lanes::zero());
  }
  /// Sets x = a sin(phase) at the time of this phase.
  void at_phase(Real phase) {
    const Real w = std::sqrt(k / m);
    state.time = phase / w;
    state.v[0].set(0, a * w * std::cos(phase));
    state.force[0].set(0, -k * a * std::sin(phase));
    ++state.step;
  }
};

TEST(EnergyResolution, IsThatOfAnOscillator) {
  // S + v.Kv = k^2 a^2/m at any time. Half of it is the bound while S is smaller.
  constexpr Real eta = 5e-3, k = Oscillator::k, m = Oscillator::m, a = Oscillator::a;
  const Real E = k * a * a / 2, half = k * k * a * a / m / 2, step = std::sqrt(8 * eta * E / half);
  Oscillator oscillator;
  EnergyResolution<2> resolution;
  oscillator.at_phase(0);
  EXPECT_EQ(resolution.longest_step(oscillator.system, oscillator.state), 0);
  oscillator.at_phase(1e-3);
  EXPECT_NEAR(resolution.longest_step(oscillator.system, oscillator.state), 0.8 * step, 1e-5);
}

TEST(EnergyResolution, RejectsAStepThatDisturbsTheBalanceByHalfAsMuchAgainAsItMay) {
  constexpr Real eta = 5e-3;
  Oscillator oscillator;
  EnergyResolution<2> resolution;
  oscillator.at_phase(0);
  resolution.longest_step(oscillator.system, oscillator.state);
  // S = f^2/m appears suddenly, as when J comes close to 0.
  constexpr Real f = 5, S = f * f / Oscillator::m;
  const Real E = Oscillator::m / 2 * sum(oscillator.state.v[0] * oscillator.state.v[0]);
  oscillator.state.force[0].set(0, f);
  const Real dt = std::sqrt(8 * 1.5 * eta * E / S);
  EXPECT_NO_THROW(resolution.judge(oscillator.system, oscillator.state, 0.99 * dt));
  EXPECT_THROW(resolution.judge(oscillator.system, oscillator.state, 1.01 * dt), StepError);
}

TEST(EnergyResolution, LetsABodyGoInShortSteps) {
  // At rest at x = a no energy is in motion yet.
  Oscillator oscillator;
  EnergyResolution<2> resolution;
  oscillator.state.force[0].set(0, -Oscillator::k * Oscillator::a);
  EXPECT_EQ(resolution.longest_step(oscillator.system, oscillator.state), 0);
  oscillator.state.time = 1e-3;
  EXPECT_EQ(resolution.longest_step(oscillator.system, oscillator.state), 0);
}

}  // namespace
}  // namespace meniscus::test_energy_resolution
