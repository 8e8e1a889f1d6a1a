// SPDX-License-Identifier: BSD-3-Clause
// Information about a failed step, as data and as a sentence.
#include "run/simulation.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_step_error {
namespace {

/// A body compressed so fast that it folds within the first step, even if this is halved six times.
const char* pressed = R"toml(
dimension = 2
[time]
end = 100
[[body]]
name = "sheet"
shape = "rectangle"
size = [2, 1]
cells = [6, 3]
initial_velocity = ["-1e6*x", 0]
material = { type = "neo_hookean", density = 1, mu = 1, lambda = 2 }
)toml";

TEST(StepErrors, SayBodyParticleStepAndCause) {
  const SceneInput input = SceneInput::from_text(pressed);
  scene_dimension(input);
  Scene<2> scene = build_scene<2>(input);
  Simulation<2> simulation(scene);
  simulation.begin();
  try {
    simulation.advance();
    FAIL() << "the sheet is not folded";
  } catch (const StepError& error) {
    const StepFailure& failure = error.failure;
    EXPECT_EQ(failure.body, "sheet");
    EXPECT_GE(failure.particle, 0);
    EXPECT_LT(failure.particle, scene.system.size());
    EXPECT_EQ(failure.step, 1);
    EXPECT_GT(failure.dt, 0);
    EXPECT_EQ(failure.time, failure.dt);
    EXPECT_EQ(failure.term, "internal force of 'sheet'");
    EXPECT_EQ(failure.cause.rfind("J = det F = -", 0), 0u) << failure.cause;
    EXPECT_TRUE(failure.of_step);
    EXPECT_EQ(failure.halvings, 6);
    EXPECT_EQ(std::string(error.what()), failure.text());
    EXPECT_EQ(failure.text().rfind("step 1, t = ", 0), 0u) << failure.text();
    EXPECT_NE(failure.text().find("body 'sheet', particle "), std::string::npos);
  }
  EXPECT_EQ(simulation.state().time, 0);  // back at the places before the step
}

TEST(StepErrors, WithoutAPlaceAreTheirCause) {
  StepFailure failure;
  failure.cause = "the stable time step has collapsed";
  EXPECT_EQ(failure.text(), failure.cause);
  failure.halvings = 6;
  EXPECT_EQ(failure.text(), failure.cause + "; the step was halved 6 times");
}

}  // namespace
}  // namespace meniscus::test_step_error
