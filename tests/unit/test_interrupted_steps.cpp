// SPDX-License-Identifier: BSD-3-Clause
// Long steps that are interrupted: they end soon and leave the state unchanged.
#include "cases.hpp"
#include "meniscus/error.hpp"
#include "run/simulation.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_interrupted_steps {
namespace {

/// Interrupts each step after 1, 10 and 100 queries of the stop function, then completes it.
void expect_no_trace(const std::string& text, int steps) {
  Scene<2> scene = test::scene_of<2>(text), same = test::scene_of<2>(text);
  Simulation<2> undisturbed(scene), disturbed(same);
  int asks_left = 0, interruptions = 0;
  disturbed.stop_when([&] { return --asks_left == 0; });
  const auto interrupt = [&](const auto& step) {
    const std::uint64_t before = disturbed.snapshot().hash();
    for (const int asks : {1, 10, 100}) {
      asks_left = asks;
      try {
        step();
        return;  // the step ended with fewer queries
      } catch (const Interrupted&) {
        ++interruptions;
        EXPECT_EQ(disturbed.snapshot().hash(), before) << "after " << asks;
      }
    }
    asks_left = 0;
    step();
  };
  undisturbed.begin();
  undisturbed.settle();
  disturbed.begin();
  interrupt([&] { disturbed.settle(); });
  for (int k = 0; k < steps; ++k) {
    undisturbed.advance();
    interrupt([&] { disturbed.advance(); });
    EXPECT_EQ(disturbed.snapshot().hash(), undisturbed.snapshot().hash()) << "step " << k;
  }
  EXPECT_GE(interruptions, 2 * steps);
  EXPECT_EQ(disturbed.take_notes(), undisturbed.take_notes());
}

/// An adhesive lid jumps onto a soft disk: the load step is divided, and the jump is noted.
TEST(InterruptedSteps, LeaveNoTraceOfALoadStep) {
  expect_no_trace(
      "dimension = 2\n[time]\nsolver = \"newton\"\nend = 4\nstep = 0.5\n"
      "[[body]]\nname = \"it\"\nshape = \"disk\"\nradius = 1\ncore = 4\nrings = 3\n"
      "[body.material]\ntype = \"neo_hookean\"\ndensity = 1\nmu = 1\nlambda = 2\n"
      "[[contact]]\nname = \"lid\"\nbodies = [\"it\"]\nepsilon = 40\nsigma0 = 0.2\nbeta = 1\n"
      "partner = { type = \"half_space\", point = [0, 1.5], normal = [0, -1], "
      "displacement = [0, \"-0.42*(1 - abs(t - 2)/2)\"] }\n"
      "[[held]]\nname = \"base\"\nbody = \"it\"\nwhere = \"y < -0.5\"\n",
      4);
}

TEST(InterruptedSteps, LeaveNoTraceOfAFlow) {
  expect_no_trace(
      "dimension = 2\n[time]\nsolver = \"newton\"\nend = 1e5\n"
      "[[body]]\nname = \"drop\"\nshape = \"ellipse\"\nsemi_axes = [1.2, 0.83]\ncore = 6\nrings = "
      "3\n"
      "material = { type = \"newtonian\", density = 1, bulk_modulus = 100, viscosity = 0.5 }\n"
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n",
      3);
}

}  // namespace
}  // namespace meniscus::test_interrupted_steps
