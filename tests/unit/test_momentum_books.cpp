// SPDX-License-Identifier: BSD-3-Clause
// The balances of momentum and angular momentum with the impulses from outside. They are exact for
// all loads, and a force that is not reported is detected.
#include "cases.hpp"
#include "run/epochs.hpp"
#include "support.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace meniscus::test_momentum_books {
namespace {

std::string solid(int D, const std::string& keys, const std::string& time = "end = 100") {
  return "dimension = " + std::to_string(D) + "\n[time]\n" + time +
         "\n[[body]]\nname = \"block\"\n" +
         (D == 3 ? "shape = \"box\"\nsize = [1, 1, 1]\ncells = [4, 4, 4]\njitter = 0.2\n"
                 : "shape = \"rectangle\"\nsize = [1, 1]\ncells = [6, 6]\njitter = 0.2\n") +
         keys + "\nmaterial = { type = \"neo_hookean\", density = 2, mu = 1, lambda = 1.5 }\n";
}
std::string half_disk_drop(const std::string& keys, const std::string& time) {
  return "dimension = 2\n[time]\nend = 100\n" + time +
         "\n[[body]]\nname = \"drop\"\nshape = \"half_disk\"\nradius = 1\ncore = 6\nrings = 3\n" +
         keys +
         "\nmaterial = { type = \"newtonian\", density = 1, bulk_modulus = 40, viscosity = 0.5 }\n"
         "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n";
}

template <int D>
struct Course {
  Scene<D> scene;
  Simulation<D> simulation;
  Ledger initial, ledger;

  Course(const std::string& text, int steps) : scene(test::scene_of<D>(text)), simulation(scene) {
    simulation.begin();
    initial = simulation.audit_now();
    for (int k = 0; k < steps && !simulation.finished(); ++k) simulation.advance();
    ledger = simulation.audit_now();
  }
  Real time() const { return simulation.state().time; }
  Real error() const { return simulation.audit().momentum_error(ledger); }
  Real angular_error() const { return simulation.audit().angular_momentum_error(ledger); }
  void expect_exact(Real tolerance = 1e-12) const {
    EXPECT_GT(ledger.kinetic, 0);
    EXPECT_LT(error(), tolerance);
    EXPECT_LT(angular_error(), tolerance);
  }
};

TEST(MomentumBooks, ADeadTractionMovesABlock) {
  const Course<3> run(
      solid(3, "initial_velocity = [\"-0.1*y\", \"0.1*x\", 0]") +
          "[[traction]]\nbody = \"block\"\nface = \"x_max\"\nforce = [0.2, 0.1, \"0.1*y\"]\n",
      60);
  EXPECT_NEAR(run.ledger.momentum[0], 0.2 * run.time(), 1e-13);
  EXPECT_NEAR(run.ledger.momentum[1], 0.1 * run.time(), 1e-13);
  run.expect_exact();
}

/// A block with corners, where the masses of the time step differ from the integrals of the
/// density; and a drop.
TEST(MomentumBooks, BodiesFallFreely) {
  const Course<2> block(solid(2, "initial_velocity = [\"-0.3*y\", \"0.3*x\"]") +
                            "[[body_force]]\nbody = \"block\"\nacceleration = [0, -1.5]\n",
                        60);
  EXPECT_NEAR(block.ledger.momentum[1], -2 * 1.5 * block.time(), 1e-12);
  block.expect_exact();
  const Course<2> drop(half_disk_drop("initial_velocity = [\"-0.3*y\", \"0.3*x\"]", "") +
                           "[[body_force]]\nbody = \"drop\"\nacceleration = [0.2, \"-1 - t\"]\n",
                       60);
  Real mass = 0;
  for (const Real m : drop.scene.system.mass) mass += m;
  EXPECT_NEAR(drop.ledger.momentum[0] - drop.initial.momentum[0], mass * 0.2 * drop.time(), 1e-12);
  drop.expect_exact();
}

TEST(MomentumBooks, EvenPressureMovesNothing) {
  const Course<3> run(solid(3, "initial_velocity = [\"0.3*x*y\", \"0.2*z\", 0]") +
                          "[[traction]]\nbody = \"block\"\nwhere = 1\npressure = \"0.3*cos(t)\"\n",
                      40);
  EXPECT_EQ(run.ledger.impulses, 0);
  run.expect_exact();
}

TEST(MomentumBooks, WallsRubAndRebound) {
  for (const std::string time : {"step = 0.004\n", "viscosity = \"implicit\"\nstep = 0.012\n"}) {
    const Course<2> run(
        half_disk_drop("initial_velocity = [0.6, -0.5]", time) +
            "[[contact]]\nname = \"wall\"\nbodies = [\"drop\"]\ncontact_angle = 90\n"
            "offset = 0.1\nrange = 0.3\nfriction = 2\npartner = { type = "
            "\"half_space\", point = [0, -0.15], normal = [0, 1], displacement = [0, "
            "\"0.01*sin(t)\"] }\n",
        80);
    EXPECT_GT(run.ledger.impulses, 0.01);
    run.expect_exact();
  }
}

TEST(MomentumBooks, SpringsAndDampersPull) {
  const Course<2> run(
      solid(2, "initial_velocity = [0.1, \"0.2*x\"]") +
          "[[spring]]\nbody = \"block\"\nface = \"x_min\"\nstiffness = 0.3\ndamping = "
          "0.1\n[[spring]]\nname = \"tip\"\nbody = \"block\"\nat = [0.5, "
          "0.5]\nconstant = 0.2\ncomponents = [\"y\"]\n",
      80);
  run.expect_exact();
}

TEST(MomentumBooks, GripsMoveAndTurn) {
  const Course<3> run(solid(3, "") +
                          "[[held]]\nbody = \"block\"\nface = \"z_min\"\nangle = \"0.2*t\"\n"
                          "displacement = [\"0.1*sin(t)\", 0, 0]\n"
                          "[[body_force]]\nbody = \"block\"\nacceleration = [0, \"x\", -1]\n",
                      60);
  EXPECT_GT(run.ledger.momentum.norm(), 0.01);
  run.expect_exact();
}

/// Damping multiplies the momenta, but does not slow down prescribed motions.
TEST(MomentumBooks, RelaxationTakesMomentum) {
  const Course<2> run(solid(2, "", "end = 100\nsolver = \"relax\"\n") +
                          "[[held]]\nbody = \"block\"\nface = \"x_min\"\ndisplacement = [0.1, "
                          "0]\nramp = [0, 1]\n"
                          "[[traction]]\nbody = \"block\"\nface = \"x_max\"\nforce = [0, 0.05]\n",
                      60);
  run.expect_exact();
}

TEST(MomentumBooks, ARemapKeepsThem) {
  const std::string text =
      "dimension = 2\n[time]\nend = 0.3\n[[body]]\nname = \"drop\"\nshape = \"disk\"\nradius = "
      "1\ncore = 6\nrings = 3\ninitial_velocity = [\"0.2 - 0.5*y\", \"0.5*x\"]\nmaterial = { type "
      "= "
      "\"newtonian\", density = 1, bulk_modulus = 40, viscosity = 0.5 }\n[[surface_tension]]\nbody "
      "= \"drop\"\ngamma = 1\n[[body_force]]\nbody = \"drop\"\nacceleration = [0.3, "
      "-1]\n[[remap]]\nbody = \"drop\"\nat = [0.1, 0.2]\n";
  const SceneInput input = SceneInput::from_text(text);
  ASSERT_EQ(scene_dimension(input), 2);
  Epochs<2> epochs(read_plan<2>(input), nullptr);
  epochs.simulation().begin();
  while (!epochs.simulation().finished()) epochs.advance();
  EXPECT_EQ(epochs.simulation().state().epoch, 2);
  const Ledger ledger = epochs.simulation().audit_now();
  EXPECT_LT(epochs.simulation().audit().momentum_error(ledger), 1e-12);
  EXPECT_LT(epochs.simulation().audit().angular_momentum_error(ledger), 1e-12);
}

/// Adds a force to particle 0 but returns an empty Report, so that the audit of momentum must find
/// an error.
class Ghost final : public ForceTerm {
 public:
  std::string name() const override { return "ghost"; }
  Report add_force(const Motion&, Forces force) override {
    force[0] += Lanes(0.1, 0, 0, 0);
    return {};
  }
};

TEST(MomentumBooks, SeeAForceThatDoesNotBelongThere) {
  Scene<2> scene = test::scene_of<2>(
      solid(2, "") + "[[traction]]\nbody = \"block\"\nface = \"x_max\"\nforce = [0.3, 0]\n");
  scene.system.terms.push_back(std::make_unique<Ghost>());
  Simulation<2> simulation(scene);
  simulation.begin();
  for (int k = 0; k < 40; ++k) simulation.advance();
  const Ledger ledger = simulation.audit_now();
  EXPECT_NEAR(ledger.momentum_excess[0], 0.1 * simulation.state().time, 1e-13);
  EXPECT_GT(simulation.audit().momentum_error(ledger), 0.1);
}

}  // namespace
}  // namespace meniscus::test_momentum_books
