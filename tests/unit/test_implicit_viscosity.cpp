// SPDX-License-Identifier: BSD-3-Clause
// Implicit viscosity: order, conservation, and steps beyond the viscous limit.
#include "meniscus/core/error.hpp"
#include "meniscus/scene/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases.hpp"
#include "io_helpers.hpp"
#include "support.hpp"

namespace meniscus::test_implicit_viscosity {
namespace {

/// A drop, elliptic in motion, that turns and flies.
std::string drop(const std::string& time, Real viscosity) {
  return "dimension = 2\n[time]\nend = 1\n" + time +
         "[[body]]\nname = \"drop\"\nshape = \"disk\"\nradius = 1\ncore = 6\nrings = 3\n"
         "initial_velocity = [\"0.3*x - 0.2*y + 0.5\", \"-0.3*y + 0.2*x\"]\n"
         "material = { type = \"newtonian\", density = 1, bulk_modulus = 20, viscosity = " +
         std::to_string(viscosity) + " }\n[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n";
}

struct Flight {
  Scene<2> scene;
  Simulation<2> simulation{scene};
  explicit Flight(const std::string& text, Real end = 0.4) : scene(test::scene_of<2>(text)) {
    simulation.begin();
    while (simulation.state().time < end * (1 - 1e-9)) simulation.advance();
  }
  const NodalVectors& u() const { return simulation.state().u; }
};

std::string implicit(Real step) {
  return "viscosity = \"implicit\"\nstep = " + std::to_string(step) + "\n";
}

TEST(ImplicitViscosity, IsOfSecondOrderAndMeetsTheExplicitMotion) {
  const Flight fine(drop("step = 0.0005\n", 0.3), 0.4);
  const auto error = [&](Real step) {
    const Flight run(drop(implicit(step), 0.3), 0.4);
    EXPECT_NEAR(run.simulation.state().time, 0.4, 1e-12);
    return test::norm(test::sum_of(run.u(), -1, fine.u())) / test::norm(fine.u());
  };
  const Real coarse = error(0.016), middle = error(0.008);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_GT(coarse / middle, 3.2);
}

TEST(ImplicitViscosity, KeepsMomentaAndBalanceWithStepsFarBeyondTheViscousLimit) {
  Flight slow(drop("viscosity = \"implicit\"\n", 30), 1);
  const Ledger ledger = slow.simulation.audit_now();
  EXPECT_LT(slow.simulation.audit().momentum_error(ledger), 1e-13);
  EXPECT_LT(slow.simulation.audit().angular_momentum_error(ledger), 1e-13);
  EXPECT_LT(std::abs(slow.simulation.audit().balance_error(ledger)), 1e-2);
  Flight by_viscosity(drop("", 30), 0.01);
  EXPECT_GT(slow.simulation.controller().stable().dt,
            20 * by_viscosity.simulation.controller().stable().dt);
}

TEST(ImplicitViscosity, IsRefusedWhereItHasNoMeaning) {
  EXPECT_THROW_WITH(test::scene_of<2>(drop("viscosity = \"implicit\"\nsolver = \"relax\"\n", 1)),
                    InputError, "viscosity");
  Scene<2> inviscid = test::scene_of<2>(drop("viscosity = \"implicit\"\n", 0));
  EXPECT_THROW_WITH(Simulation<2>{inviscid}, InputError, "this has none");
}

}  // namespace
}  // namespace meniscus::test_implicit_viscosity
