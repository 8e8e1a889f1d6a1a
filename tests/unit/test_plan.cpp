// SPDX-License-Identifier: BSD-3-Clause
// A plan is read once; scenes can be built from it any number of times.
#include <fmt/core.h>
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

template <int D>
Real default_support(const std::string& shape, const std::string& material,
                     const std::string& more = "") {
  const SceneInput input =
      SceneInput::from_text(fmt::format("dimension = {}\n[time]\nend = 1\n[[body]]\nname = "
                                        "\"body\"\n{}\n{}{}",
                                        D, shape, material, more));
  scene_dimension(input);
  const Real factor = read_plan<D>(input).bodies.front().settings.support_factor.value();
  EXPECT_NE(input.complete().find(fmt::format("support_factor = {}", factor)), std::string::npos);
  return factor;
}

/// Performance note 3.1.
TEST(Plan, SupportsAreAsWideAsTheirUseAsksFor) {
  const auto box = [](const char* size) {
    return fmt::format("shape = \"box\"\ncells = [4, 4, 4]\nsize = {}", size);
  };
  const std::string solid = example_solid(), cube = box("[1, 1, 1]"),
                    ball = "shape = \"ball\"\nradius = 1\ncore = 2\nlayers = 2",
                    tension = "[[surface_tension]]\nbody = \"body\"\ngamma = 1\nform = ";
  EXPECT_EQ(default_support<3>(cube, solid), 1.5);
  EXPECT_EQ(default_support<3>(cube, example_liquid()), 1.8);
  EXPECT_EQ(default_support<3>(cube + "\nsupport_factor = 1.7", solid), 1.7);
  EXPECT_EQ(default_support<2>("shape = \"rectangle\"\ncells = [4, 4]\nsize = [1, 1]", solid), 1.8);
  EXPECT_EQ(default_support<3>(box("[1, 1, 1.1]"), solid), 1.5);
  EXPECT_EQ(default_support<3>(box("[1, 1, 1.4]"), solid), 1.8);
  EXPECT_EQ(default_support<3>(box("[1, 1, 0.7]"), solid), 1.8);
  EXPECT_EQ(default_support<3>("shape = \"ellipsoid\"\nsemi_axes = [1, 1, 2]\ncore = 2\nlayers = 2",
                               solid),
            1.5);
  EXPECT_EQ(default_support<3>(ball, solid, tension + "\"balanced\"\n"), 1.5);
  EXPECT_EQ(default_support<3>(ball, solid, tension + "\"curvature\"\n"), 1.8);
}

}  // namespace
}  // namespace meniscus::test_plan
