// SPDX-License-Identifier: BSD-3-Clause
// A plan is read once; scenes can be built from it any number of times.
#include <gtest/gtest.h>

#include "cases.hpp"

namespace meniscus::test_plan {
namespace {

template <int D>
std::uint64_t state_after(Scene<D> scene, int steps) {
  Simulation<D> simulation(scene);
  simulation.begin();
  for (int k = 0; k < steps; ++k) simulation.advance();
  return simulation.snapshot().hash();
}

template <int D>
void expect_equal_builds() {
  for (const test::Case& c : test::cases<D>()) {
    SCOPED_TRACE(c.name);
    const SceneInput input = SceneInput::from_text(c.scene);
    scene_dimension(input);
    const Plan<D> plan = read_plan<D>(input);
    const std::uint64_t first = state_after<D>(build(plan), 5);
    EXPECT_EQ(state_after<D>(build(plan), 5), first);
    EXPECT_NE(state_after<D>(build(plan), 6), first);
  }
}

TEST(Plan, CanBeBuiltAgain) {
  expect_equal_builds<2>();
  expect_equal_builds<3>();
}

}  // namespace
}  // namespace meniscus::test_plan
