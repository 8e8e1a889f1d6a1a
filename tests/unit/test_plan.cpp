// SPDX-License-Identifier: BSD-3-Clause
// A plan is read once; any number of scenes can be built from it.
#include "cases.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <numeric>

namespace meniscus::test_plan {
namespace {

/// The state after three steps.
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

/// The references of the bodies of a scene, as a map for build().
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
BodySettings settings_of(const std::string& shape, const std::string& material,
                         const std::string& more = "") {
  const SceneInput input =
      SceneInput::from_text(fmt::format("dimension = {}\n[time]\nend = 1\n[[body]]\nname = "
                                        "\"body\"\n{}\n{}{}",
                                        D, shape, material, more));
  scene_dimension(input);
  BodySettings settings = read_plan<D>(input).bodies.front().settings;
  EXPECT_NE(input.complete().find(fmt::format("support_factor = {}", *settings.support_factor)),
            std::string::npos);
  return settings;
}
template <int D>
Real default_support(const std::string& shape, const std::string& material,
                     const std::string& more = "") {
  return settings_of<D>(shape, material, more).support_factor.value();
}

/// Default supports of performance note 3.1.
TEST(Plan, SupportsAreAsWideAsTheirUseAsksFor) {
  const std::string solid = example_solid(),
                    cube = "shape = \"box\"\ncells = [4, 4, 4]\nsize = [1, 1, 1]",
                    ball = "shape = \"ball\"\nradius = 1\ncore = 2\nlayers = 2",
                    tension = "[[surface_tension]]\nbody = \"body\"\ngamma = 1\nform = ";
  EXPECT_EQ(default_support<3>(cube, solid), 1.5);
  EXPECT_EQ(default_support<3>(cube, example_liquid()), 1.8);
  EXPECT_EQ(default_support<3>(ball, example_liquid()), 1.5);
  EXPECT_EQ(default_support<3>(ball + "\nwindow = \"cubic_spline\"", example_liquid()), 1.8);
  EXPECT_EQ(default_support<3>(cube + "\nsupport_factor = 1.7", solid), 1.7);
  EXPECT_EQ(default_support<2>("shape = \"rectangle\"\ncells = [4, 4]\nsize = [1, 1]", solid), 1.8);
  EXPECT_EQ(default_support<3>(ball, solid, tension + "\"balanced\"\n"), 1.5);
  EXPECT_EQ(default_support<3>(ball, solid, tension + "\"curvature\"\n"), 1.8);
}

/// Performance note 3.2.
TEST(Plan, RoundLiquidsIn3DHaveTheTriweightUnlessMoreThanValuesCount) {
  const std::string ball = "shape = \"ball\"\nradius = 1\ncore = 2\nlayers = 2\n",
                    disk = "shape = \"disk\"\nradius = 1\ncore = 4\nrings = 2\n",
                    tension = "[[surface_tension]]\nbody = \"body\"\ngamma = 1\nform = ",
                    varies =
                        "[[surface]]\nbody = \"body\"\n[surface.law]\ntype = "
                        "\"varying_tension\"\ngamma = \"1 + 0.1*z\"\n";
  const auto window = [&](const std::string& more) {
    return settings_of<3>(ball, example_liquid(), more).window;
  };
  EXPECT_EQ(window(""), "triweight");
  EXPECT_EQ(window(tension + "\"balanced\"\n"), "triweight");
  EXPECT_EQ(window(tension + "\"curvature\"\n"), "cubic_spline");
  EXPECT_EQ(window(varies), "cubic_spline");
  EXPECT_EQ(settings_of<3>(ball, example_solid()).window, "cubic_spline");
  EXPECT_EQ(settings_of<3>("shape = \"half_sphere\"\nradius = 1\ncore = 4\nlayers = 2\n",
                           example_liquid())
                .window,
            "cubic_spline");
  EXPECT_EQ(settings_of<2>(disk, example_liquid()).window, "cubic_spline");
}

TEST(Plan, SupportsOfSolidsInSpaceDoNotGrowAtFaces) {
  const std::string ball = "shape = \"ball\"\nradius = 1\ncore = 2\nlayers = 2\n";
  EXPECT_EQ(settings_of<3>(ball, example_solid()).support_by, "cells");
  EXPECT_EQ(settings_of<3>(ball + "support_rank = 18\n", example_solid()).support_by, "neighbours");
  EXPECT_EQ(settings_of<3>(ball, example_liquid()).support_by, "neighbours");
  EXPECT_EQ(settings_of<2>("shape = \"disk\"\nradius = 1\ncore = 4\nrings = 2\n", example_solid())
                .support_by,
            "neighbours");
}

/// Default supports of cells note 6.
TEST(Plan, SupportsOfNematicsInThePlaneDoNotGrowAtTheSurface) {
  const std::string nematic =
                        "[body.material]\ntype = \"nematic\"\ndensity = 1\nbulk_modulus = 100\n"
                        "viscosity = 1\nfrank_constant = 1\nrotational_viscosity = 1\n"
                        "flow_alignment = 1\n",
                    disk = "shape = \"disk\"\nradius = 1\ncore = 4\nrings = 2\n",
                    ball = "shape = \"ball\"\nradius = 1\ncore = 2\nlayers = 2\n";
  EXPECT_EQ(settings_of<2>(disk, nematic).support_by, "cells");
  EXPECT_EQ(settings_of<2>(disk + "support_rank = 9\n", nematic).support_by, "neighbours");
  EXPECT_EQ(settings_of<2>(disk + "support_by = \"neighbours\"\n", nematic).support_by,
            "neighbours");
  EXPECT_EQ(settings_of<3>(ball, nematic).support_by, "neighbours");
  EXPECT_EQ(settings_of<2>(disk, example_liquid()).support_by, "neighbours");
  EXPECT_EQ(settings_of<3>(ball + "support_by = \"cells\"\n", example_solid()).support_by, "cells");
}

/// Supports of a scene are the given multiples of the diagonals of cells, at the surface and
/// inside.
TEST(Plan, SupportsByCellsAreMultiplesOfTheirDiagonals) {
  const SceneInput input = SceneInput::from_text(
      "dimension = 3\n[time]\nend = 1\n[[body]]\nname = \"body\"\nshape = \"box\"\ncells = [3, 3, "
      "3]\n"
      "size = [3, 3, 3]\nsupport_by = \"cells\"\nsupport_factor = 1.6\n" +
      example_solid());
  scene_dimension(input);
  const Scene<3> scene = build(read_plan<3>(input));
  for (const Real support : scene.system.bodies.front().particles.support())
    EXPECT_NEAR(support, 1.6 * std::sqrt(3), 1e-14);
}

}  // namespace
}  // namespace meniscus::test_plan
