// SPDX-License-Identifier: BSD-3-Clause
// Shells, cavities and profiles in scenes.
#include "meniscus/error.hpp"
#include "scene/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace meniscus::test_scene_shells {
namespace {

const std::string shell = R"toml(
dimension = 3
time = { end = 1 }
[[body]]
name = "cell"
shape = "disk_shell"
radius = 2
height = 1.6
thickness = 0.4
spacing = 0.6
material = { type = "neo_hookean", density = 1, mu = 1, lambda = 5 }
)toml";

Scene<3> scene_of(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  return build_scene<3>(input);
}

void expect_refused(const std::string& text, const std::string& part) {
  try {
    scene_of(text);
    ADD_FAILURE() << "not refused: " << text;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(SceneShells, HaveCellMeasuresAndThoseOfTheirCavity) {
  const Scene<3> scene = scene_of(shell + R"toml(
[[cavity]]
body = "cell"
[[profile]]
body = "cell"
r = [2]
z = [0]
)toml");
  for (const char* name : {"diameter", "thickness_ratio", "cavity_gap", "evans_fung_rms",
                           "cavity_fraction", "cavity_pressure", "profile_rms"}) {
    const auto same = [&](const MeasureSource& m) { return m.name == std::string("cell.") + name; };
    EXPECT_EQ(std::count_if(scene.measures.begin(), scene.measures.end(), same), 1) << name;
  }
}

TEST(SceneShells, WrongCavitiesAreRefused) {
  const std::string cavity = shell + "[[cavity]]\nbody = \"cell\"\n";
  expect_refused(cavity + "pressure = 1\nvolume_target = 0.7\npenalty = 1\n", "one of them");
  expect_refused(cavity + "volume_target = 0.7\n", "both or neither");
  expect_refused(cavity + "penalty = 3\n", "both or neither");
  expect_refused(cavity + "surface = \"middle\"\n", "allowed");
  expect_refused(cavity + "[[cavity]]\nbody = \"cell\"\n", "one per body");
  expect_refused(shell + "[[cavity]]\nbody = \"drop\"\n", "no body");
  expect_refused(shell + "[[profile]]\nbody = \"cell\"\nr = [1, 2]\nz = [0]\n", "r has 2");
}

TEST(SceneShells, SolidBodiesHaveNoInnerSurface) {
  const std::string ball = R"toml(
dimension = 3
time = { end = 1 }
[[body]]
name = "ball"
shape = "ball"
radius = 1
core = 3
layers = 2
material = { type = "neo_hookean", density = 1, mu = 1, lambda = 5 }
)toml";
  expect_refused(ball + "[[cavity]]\nbody = \"ball\"\n", "no inner surface");
  expect_refused(ball + "[[profile]]\nbody = \"ball\"\nr = [1]\nz = [0]\n", "not a shell");
  EXPECT_NO_THROW(scene_of(ball + "[[cavity]]\nbody = \"ball\"\nsurface = \"outer\"\n"));
}

TEST(SceneShells, FacesThatTouchStopTheRunWithTheCause) {
  Scene<3> scene = scene_of(shell + "[[cavity]]\nbody = \"cell\"\n");
  State& state = scene.initial;
  const Body<3>& body = scene.system.bodies.front();
  for (Index A = 0; A < body.size(); ++A) {
    const Vec<3>& X = at(body.particles.X(), A);
    const Real dent = 0.5 * std::exp(-X.head<2>().squaredNorm());
    at(state.u, A).set(2, X[2] > 0 ? -dent : dent);
  }
  try {
    scene.system.compute_forces(state.motion(), state.force);
    ADD_FAILURE() << "not stopped";
  } catch (const SolveError& error) {
    EXPECT_NE(std::string(error.what()).find("opposite inner faces of the cavity touch"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace meniscus::test_scene_shells
