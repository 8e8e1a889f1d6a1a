// SPDX-License-Identifier: BSD-3-Clause
// Fluids that flow to equilibrium by implicit Euler and Newton's method: the resistance of a step,
// exact circles, spheres and rates, energy balance, restarts, refused scenes.
#include "cases.hpp"
#include "io_helpers.hpp"
#include "meniscus/error.hpp"
#include "run/simulation.hpp"
#include "solve/newton/implicit_euler.hpp"
#include "support.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace meniscus::test_flow_to_rest {
namespace {

constexpr Real gamma = 1, bulk_modulus = 100;

/// An ellipse (3D: an ellipsoid) of fluid under surface tension.
std::string drop(int D, const std::string& time, Real viscosity, const std::string& more = "") {
  return "dimension = " + std::to_string(D) + "\n[time]\nsolver = \"newton\"\n" + time +
         "[[body]]\nname = \"drop\"\n" +
         (D == 3 ? "shape = \"ellipsoid\"\nsemi_axes = [0.9, 1.2, 0.9]\ncore = 2\nlayers = 2\n"
                 : "shape = \"ellipse\"\nsemi_axes = [1.2, 0.83]\ncore = 6\nrings = 3\n") +
         "material = { type = \"newtonian\", density = 1, bulk_modulus = 100, viscosity = " +
         std::to_string(viscosity) + " }\n[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n" + more;
}

/// A run with the values that its history would have at each step.
template <int D>
struct Flow {
  Scene<D> scene;
  Simulation<D> simulation;
  Real first_balance = 0;
  std::vector<Real> steps, p2, energies;

  explicit Flow(const std::string& text) : scene(test::scene_of<D>(text)), simulation(scene) {
    simulation.begin();
    first_balance = ledger().balance();
    look();
  }
  void go(std::int64_t steps_at_most = 100) {
    while (!simulation.finished() && simulation.state().step < steps_at_most) {
      simulation.advance();
      steps.push_back(simulation.last_step());
      look();
    }
  }
  void look() {
    p2.push_back(measure("drop.p2"));
    Real energy = 0;
    for (const auto& [kind, stored] : ledger().stored) energy += stored;
    energies.push_back(energy);
  }
  Ledger ledger() const { return take_ledger(scene.system, simulation.state()); }
  /// The error relative to the dissipated energy.
  Real balance_error() const { return (ledger().balance() - first_balance) / ledger().dissipated; }
  Real energy_left() const {
    return simulation.stepper().residuals(simulation.state()).front().value;
  }
  Real measure(const std::string& name) const {
    for (const MeasureSource& m : scene.measures)
      if (m.name == name) return m.compute(simulation.state().motion());
    throw std::logic_error(name);
  }
};

/// The force of the resistance is minus the gradient of its potential, and its tangent is linear,
/// symmetric and positive.
template <int D>
void expect_resistance() {
  Scene<D> scene = test::scene_of<D>(drop(D, "end = 1\n", 0.5));
  ImplicitEuler<D> step(scene.system);
  const Index n = scene.system.size();
  const NodalVectors from = test::random_field<D>(n, 0.02, 1), a = test::random_field<D>(n, 1, 2),
                     b = test::random_field<D>(n, 1, 3), still(from.size(), Lanes::zero());
  step.begin(0, from, 0.3);
  const auto potential = [&](Real h, NodalVectors& force) {
    force = still;
    return step.add_force(test::sum_of(from, h, a), force);
  };
  NodalVectors force, Ra = still, Rb = still;
  const Real E = potential(0.1, force);
  step.look_back();
  step.add_change(a, Ra);
  step.add_change(b, Rb);
  EXPECT_LT(test::norm(test::sum_of(force, -0.1, Ra)), 1e-13 * test::norm(force));
  EXPECT_NEAR(E / (-0.005 * test::dot(a, Ra)), 1, 1e-13);
  EXPECT_NEAR(test::dot(a, Rb) / test::dot(b, Ra), 1, 1e-12);
  EXPECT_EQ(potential(0, force), 0);
}

TEST(ImplicitEuler, ResistsByAPotentialOfTheIncrement) {
  expect_resistance<2>();
  expect_resistance<3>();
}

/// The radius at rest under surface tension: kappa ln J = - (D - 1) gamma / R.
Real radius_at_rest(int D, Real reference) {
  Real R = reference;
  for (int k = 0; k < 20; ++k) R = reference * std::exp(-(D - 1) * gamma / (R * bulk_modulus * D));
  return R;
}

TEST(FlowToRest, TakesAPlaneDropToTheCircle) {
  Flow<2> run(drop(2, "end = 1e5\nforce_tolerance = 1e-8\n", 0.5));
  run.go();
  EXPECT_TRUE(run.simulation.stepper().arrived());
  EXPECT_LE(run.energy_left(), 1e-8);
  EXPECT_LT(run.simulation.state().step, 20);
  EXPECT_NEAR(run.measure("drop.isoperimetric"), 1, 2e-6);
  EXPECT_NEAR(run.p2.back(), 0, 2e-4);
  const Real R = radius_at_rest(2, std::sqrt(1.2 * 0.83));
  EXPECT_NEAR(run.measure("drop.area") / (2 * std::numbers::pi * R), 1, 1e-4);
  for (std::size_t k = 1; k < run.energies.size(); ++k)
    EXPECT_LT(run.energies[k], run.energies[k - 1]) << k;
  EXPECT_LT(std::abs(run.balance_error()), 1e-5);
  EXPECT_GT(run.steps.back(), 8 * run.steps.front());
}

TEST(FlowToRest, TakesADropToTheSphere) {
  std::string scene = drop(3, "end = 1e5\n", 0.5);
  // The smoothest surface at rest (performance note 3.2): there are 79 particles.
  scene.insert(scene.find("\nmaterial"), "\nwindow = \"cubic_spline\"");
  Flow<3> run(scene);
  run.go();
  EXPECT_TRUE(run.simulation.stepper().arrived());
  EXPECT_LE(run.energy_left(), 1e-5);
  EXPECT_NEAR(run.measure("drop.isoperimetric"), 1, 5e-5);
  EXPECT_NEAR(run.measure("drop.aspect"), 1, 5e-3);
  const Real R = radius_at_rest(3, std::cbrt(0.9 * 0.9 * 1.2));
  EXPECT_NEAR(run.measure("drop.area") / (4 * std::numbers::pi * R * R), 1, 1e-3);
  EXPECT_LT(std::abs(run.balance_error()), 1e-3);
}

/// A viscous plane drop that is nearly round. Its second mode decays at the rate gamma / (2 mu R) n
/// with n = 2 (Lamb 1932, without inertia); a step of implicit Euler multiplies it by 1/(1 + tau
/// rate).
TEST(FlowToRest, FlowsAtTheRateOfViscosity) {
  constexpr Real viscosity = 100;
  std::string text = drop(2, "end = 1e5\n", viscosity);
  text.replace(text.find("[1.2, 0.83]"), 11, "[1.02, 0.98]");
  Flow<2> run(text);
  run.go(9);
  const Real rate = gamma / (viscosity * std::sqrt(1.02 * 0.98));
  Real expected = run.p2[0];
  for (std::size_t k = 0; k < run.steps.size(); ++k) {
    expected /= 1 + run.steps[k] * rate;
    EXPECT_NEAR(run.p2[k + 1] / expected, 1, 0.02) << k;
  }
  EXPECT_LT(run.p2.back(), 0.7 * run.p2.front());
}

/// While a load grows, the steps of the drop are at most the load step, and the supplied energy is
/// booked as work.
TEST(FlowToRest, FollowsLoadsThatChange) {
  Flow<2> run(drop(2, "end = 2\nstep = 0.25\n", 0.5,
                   "[[body_force]]\nbody = \"drop\"\nacceleration = [0, \"0.5*y*min(t, 2)\"]\n"));
  run.go();
  EXPECT_EQ(run.simulation.state().time, 2);
  EXPECT_TRUE(run.simulation.stepper().arrived());
  EXPECT_GE(run.steps.size(), 8u);
  const Ledger ledger = run.ledger();
  EXPECT_GT(ledger.external_work, 0.03);
  EXPECT_GT(ledger.dissipated, 0);
  EXPECT_LT(std::abs(run.balance_error()), 2e-2);
}

/// A run on two threads continues the state of a run on three threads.
template <int D>
void expect_same_bits() {
  const std::string text = drop(D, "end = 1e5\n", 0.5);
  constexpr std::int64_t steps = D == 3 ? 2 : 4;
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  Flow<D> alone(text);
  alone.go(steps);
  const std::uint64_t hash = alone.simulation.snapshot().hash();
  omp_set_num_threads(3);
  Flow<D> run(text);
  run.go(1);
  const Snapshot kept = run.simulation.snapshot();
  run.go(steps);
  EXPECT_EQ(run.simulation.snapshot().hash(), hash);
  omp_set_num_threads(2);
  Flow<D> restarted(text);
  restarted.simulation.restore(kept);
  EXPECT_EQ(restarted.simulation.snapshot().hash(), kept.hash());
  restarted.go(steps);
  EXPECT_EQ(restarted.simulation.snapshot().hash(), hash);
  omp_set_num_threads(before);
}

TEST(FlowToRest, HasTheSameBitsForAnyThreadsAndThroughARestart) {
  expect_same_bits<2>();
  expect_same_bits<3>();
}

/// A drop and a soft disk that adhere to each other come to rest together.
TEST(FlowToRest, TakesSolidsAlong) {
  std::string text =
      drop(2, "end = 1e4\nforce_tolerance = 1e-3\n", 0.5,
           "[[body]]\nname = \"disk\"\nshape = \"disk\"\nradius = 1\ncore = 4\n"
           "rings = 2\ncentre = [2.45, 0]\n"
           "material = { type = \"neo_hookean\", density = 1, mu = 3, lambda = 10 }\n"
           "[[contact]]\nname = \"touch\"\nbodies = [\"drop\", \"disk\"]\n"
           "interaction = \"smooth_young\"\nadhesion = 0.6\noffset = 0.1\n"
           "range = 0.2\n");
  text.replace(text.find("core = 6\nrings = 3"), 18, "core = 4\nrings = 2");
  Flow<2> run(text);
  const Real apart = run.measure("disk.centre_x") - run.measure("drop.centre_x");
  run.go();
  EXPECT_TRUE(run.simulation.stepper().arrived());
  EXPECT_LE(run.energy_left(), 1e-3);
  EXPECT_LT(run.measure("disk.centre_x") - run.measure("drop.centre_x"), apart - 0.1);
  EXPECT_LT(std::abs(run.balance_error()), 5e-3);
  EXPECT_GT(run.ledger().stored.at("strain"), 0);
  EXPECT_LT(run.ledger().stored.at("contact"), -0.1);
}

/// A fluid disk starts in an unstable equilibrium under a force that pulls its two sides apart. It
/// leaves this equilibrium.
TEST(FlowToRest, LeavesWhatIsUnstable) {
  std::string text =
      drop(2, "end = 30\n", 1, "[[body_force]]\nbody = \"drop\"\nacceleration = [0, \"4*y\"]\n");
  text.replace(text.find("[1.2, 0.83]"), 11, "[1.001, 1]");
  Flow<2> run(text);
  const Real first = std::abs(run.p2.front());
  while (!run.simulation.finished() && std::abs(run.p2.back()) < 0.5)
    run.go(run.simulation.state().step + 1);
  EXPECT_LT(first, 1e-3);
  EXPECT_GT(std::abs(run.p2.back()), 0.5);
  EXPECT_LT(std::abs(run.balance_error()), 1e-3);
}

TEST(FlowToRest, IsRefusedWithoutViscosity) {
  Scene<2> inviscid = test::scene_of<2>(drop(2, "end = 1\n", 0));
  EXPECT_THROW_WITH(Simulation<2>{inviscid}, InputError,
                    "body 'drop' is a fluid without viscosity");
}

}  // namespace
}  // namespace meniscus::test_flow_to_rest
