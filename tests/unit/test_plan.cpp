// SPDX-License-Identifier: BSD-3-Clause
// A plan is read once; scenes can be built from it any number of times.
#include <gtest/gtest.h>

#include <numeric>

#include "cases.hpp"

namespace meniscus::test_plan {
namespace {

/// After three steps.
template <int D>
struct Outcome {
  explicit Outcome(Scene<D> scene) {
    Simulation<D> simulation(scene);
    simulation.begin();
    for (int k = 0; k < 3; ++k) simulation.advance();
    snapshot = simulation.snapshot().hash();
    state = hash_of(simulation.state());
    simulation.advance();
    next = simulation.snapshot().hash();
  }
  static std::uint64_t hash_of(State state) {
    Snapshot kept;
    state.archive(Archive::writing(kept), D);
    return kept.hash();
  }
  std::uint64_t snapshot, state, next;
};

/// The references that the bodies of a scene have anyway.
template <int D>
References<D> references_of(const Scene<D>& scene) {
  References<D> references;
  for (const Body<D>& body : scene.system.bodies)
    references[body.name] = std::make_shared<const Reference<D>>(Reference<D>::of_scene(
        body.geometry, std::accumulate(body.mass.begin(), body.mass.end(), 0.0)));
  return references;
}

template <int D>
void expect_equal_builds() {
  for (const test::Case& c : test::cases<D>()) {
    SCOPED_TRACE(c.name);
    const SceneInput input = SceneInput::from_text(c.scene);
    scene_dimension(input);
    const Plan<D> plan = read_plan<D>(input);
    Scene<D> scene = build(plan);
    const References<D> references = references_of(scene);
    const Outcome<D> first(std::move(scene));
    EXPECT_EQ(Outcome<D>(build(plan)).snapshot, first.snapshot);
    EXPECT_EQ(Outcome<D>(build(plan, references)).state, first.state);
    EXPECT_NE(first.next, first.snapshot);
  }
}

TEST(Plan, CanBeBuiltAgainAndOnTheReferencesOfTheSceneIn2D) {
  expect_equal_builds<2>();
}

TEST(Plan, CanBeBuiltAgainAndOnTheReferencesOfTheSceneIn3D) {
  expect_equal_builds<3>();
}

}  // namespace
}  // namespace meniscus::test_plan
