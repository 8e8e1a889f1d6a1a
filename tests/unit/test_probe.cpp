// SPDX-License-Identifier: BSD-3-Clause
// Probes: values of known fields, and messages for wrong probes.
#include "cases.hpp"
#include "meniscus/error.hpp"
#include "meniscus/run.hpp"
#include "scene/scene.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace meniscus::test_probe {
namespace {

// Linear displacement and velocity, and a load whose field is a component of the displacement.
const std::string linear = R"toml(
dimension = 3
time = { end = 1 }
[[body]]
name = "block"
shape = "box"
size = [1, 2, 0.5]
cells = [4, 6, 3]
initial_displacement = ["0.1*x - 0.05*y + 0.2", "0.03*z", "0.02*x + 0.04*y"]
initial_velocity = ["3 + x", "2*y - z", "5*x"]
material = { type = "neo_hookean", density = 3, mu = 3, lambda = 10 }
[[demo_springs]]
body = "block"
stiffness = 2
)toml";

Real u_x(Real x, Real y) {
  return 0.1 * x - 0.05 * y + 0.2;
}

TEST(Probe, ReadsLinearFieldsExactly) {
  const meniscus::Run run = meniscus::Run::from_text(linear + R"toml(
[[probe]]
name = "tip"
body = "block"
at = [0.37, -0.81, 0.11]
fields = ["position", "displacement", "velocity", "demo_stretch", "F"]
)toml");
  const Real x = 0.37, y = -0.81, z = 0.11;
  const auto tip = [&](const std::string& name) { return run.measure("tip." + name); };
  EXPECT_NEAR(tip("displacement_x"), u_x(x, y), 1e-13);
  EXPECT_NEAR(tip("displacement_y"), 0.03 * z, 1e-13);
  EXPECT_NEAR(tip("displacement_z"), 0.02 * x + 0.04 * y, 1e-13);
  EXPECT_NEAR(tip("position_x"), x + u_x(x, y), 1e-13);
  EXPECT_NEAR(tip("velocity_x"), 3 + x, 1e-12);
  EXPECT_NEAR(tip("velocity_y"), 2 * y - z, 1e-12);
  EXPECT_NEAR(tip("velocity_z"), 5 * x, 1e-12);
  EXPECT_NEAR(tip("demo_stretch"), u_x(x, y), 1e-13);
  EXPECT_NEAR(tip("F_xx"), 1.1, 1e-12);
  EXPECT_NEAR(tip("F_xy"), -0.05, 1e-12);
  EXPECT_NEAR(tip("F_zx"), 0.02, 1e-12);
}

TEST(Probe, ReadsThemAlongALine) {
  const auto scene = test::scene_of<3>(linear + R"toml(
[[probe]]
name = "edge"
body = "block"
from = [-0.5, -1, 0.25]
to = [0.5, 1, 0.25]
points = 11
fields = ["velocity", "demo_stretch"]
)toml");
  ASSERT_EQ(scene.lines.size(), 1u);
  const ProbedLine& line = scene.lines.front();
  std::vector<std::string> names;
  for (const auto& column : line.columns) names.push_back(column.name);
  EXPECT_EQ(names, (std::vector<std::string>{"distance", "velocity_x", "velocity_y", "velocity_z",
                                             "demo_stretch"}));
  const auto table = line.compute(scene.initial.motion());
  ASSERT_EQ(table.size(), 11u);
  for (std::size_t k = 0; k < table.size(); ++k) {
    const Real s = static_cast<Real>(k) / 10, x = -0.5 + s, y = -1 + 2 * s;
    ASSERT_EQ(table[k].size(), 5u);
    EXPECT_NEAR(table[k][0], s * std::sqrt(5.0), 1e-14);
    EXPECT_NEAR(table[k][1], 3 + x, 1e-12);
    EXPECT_NEAR(table[k][2], 2 * y - 0.25, 1e-12);
    EXPECT_NEAR(table[k][4], u_x(x, y), 1e-13);
  }
}

/// Probes at points are columns of the history by default; probes along lines are not.
TEST(Probe, IsInTheHistory) {
  const auto scene = test::scene_of<2>("dimension = 2\ntime = { end = 1 }\n" + test::two_drops(2) +
                                       "[[probe]]\nname = \"p\"\nbody = \"other\"\nat = [2.2, 0]\n"
                                       "[[probe]]\nname = \"l\"\nbody = \"drop\"\nfrom = [0, 0]\n"
                                       "to = [0, 1]\n");
  EXPECT_EQ(scene.output.measures, (std::vector<std::string>{"p.displacement_x", "p.displacement_y",
                                                             "p.velocity_x", "p.velocity_y"}));
  EXPECT_EQ(scene.lines.front().compute(scene.initial.motion()).size(), 50u);
}

/// The probe belongs to the body that contains it, not to the other body.
TEST(Probe, MovesWithItsBody) {
  meniscus::Run run =
      meniscus::Run::from_text("dimension = 2\ntime = { end = 1 }\n" + test::two_drops(2) +
                               "[[probe]]\nname = \"p\"\nbody = \"other\"\nat = [2.3, 0.1]\n"
                               "[[probe]]\nname = \"q\"\nbody = \"drop\"\nat = [0.3, 0.1]\n");
  run.advance_to(0.1);
  EXPECT_NEAR(run.measure("p.displacement_x"), -0.2 * run.time(), 1e-12);
  EXPECT_NEAR(run.measure("p.velocity_x"), -0.2, 1e-12);
  EXPECT_EQ(run.measure("q.displacement_x"), 0);
}

/// A drop that flies and rotates: the probe stays at its material point through two remaps.
TEST(Probe, StaysWhereItIsWhenTheBodyIsReferredAnew) {
  const std::string scene = R"toml(
dimension = 2
time = { end = 0.6 }
[[body]]
name = "drop"
shape = "disk"
radius = 1
core = 6
rings = 3
initial_velocity = ["3 - 0.4*y", "2 + 0.4*x"]
material = { type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }
[[probe]]
name = "p"
body = "drop"
at = [0.4, -0.5]
)toml";
  meniscus::Run kept = meniscus::Run::from_text(scene),
                anew = meniscus::Run::from_text(scene +
                                                "[[remap]]\nbody = \"drop\"\nat = [0.2, 0.4]\n");
  constexpr Real near = 1e-4;  // a thousandth of a spacing
  kept.advance_to(0.2);
  anew.advance_to(0.2);
  ASSERT_EQ(kept.step(), anew.step());
  EXPECT_GT(kept.measure("p.displacement_x"), 0.6);
  for (const char* name : {"p.displacement_x", "p.displacement_y"})
    EXPECT_NEAR(anew.measure(name), kept.measure(name), near) << name;
  for (const char* name : {"p.velocity_x", "p.velocity_y"})
    EXPECT_NEAR(anew.measure(name), kept.measure(name), 1e-4) << name;
  Real time = 0, x = 0, y = 0;
  while (anew.time() < 0.4) {  // through the second remap
    time = anew.time();
    x = anew.measure("p.displacement_x");
    y = anew.measure("p.displacement_y");
    anew.advance();
  }
  const Real dt = anew.time() - time;
  EXPECT_NEAR(anew.measure("p.displacement_x"), x + dt * anew.measure("p.velocity_x"), near);
  EXPECT_NEAR(anew.measure("p.displacement_y"), y + dt * anew.measure("p.velocity_y"), near);
}

std::string refusal(const std::string& lines) {
  try {
    test::scene_of<2>("dimension = 2\ntime = { end = 1 }\n" + test::two_drops(2) + "[[probe]]\n" +
                      lines);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const std::string& lines, const std::string& words) {
  const std::string message = refusal(lines);
  EXPECT_NE(message.find(words), message.npos) << lines << message;
  EXPECT_TRUE(message.starts_with("scene:")) << message;
}

TEST(Probe, WhatCannotBeIsRefused) {
  const std::string p = "name = \"p\"\nbody = \"drop\"\n";
  EXPECT_EQ(refusal(p + "at = [0.6, 0.8]\n"), "");  // on the round surface
  expect_refused(p + "at = [0.7, 0.95]\n",
                 "probe[0].at: (0.7, 0.95) is outside of body 'drop'; allowed are places in its "
                 "reference, which occupies [-1, 1] x [-1, 1]");
  expect_refused(p + "from = [0, 0]\nto = [3, 0]\n", "probe[0].from: (1.");
  expect_refused(
      p + "at = [0, 0]\nfields = [\"presure\"]\n",
      "probe[0].fields: 'presure' is unknown; allowed are position, displacement, velocity, ");
  expect_refused(p + "at = [0, 0]\nfields = [\"velocity\", \"velocity\"]\n", "is named twice");
  expect_refused(p + "at = [0, 0]\nfields = []\n", "names none");
  expect_refused(p, "at: is missing: give at for a point, or from and to for a line");
  expect_refused(p + "at = [0, 0]\nto = [0, 1]\n", "at: is of a point");
  expect_refused(p + "from = [0, 0]\n", "to: has 0 numbers; allowed are 2");
  expect_refused(p + "at = [0, 0, 0]\n", "at: has 3 numbers; allowed are 2");
  expect_refused(p + "from = [0, 0]\nto = [0, 0]\n", "to: is where the line begins");
  expect_refused(p + "at = [0, 0]\npoints = 5\n", "points: has no meaning for a point");
  expect_refused(p + "from = [0, 0]\nto = [0, 1]\npoints = 1\n", "points: 1 is out of range");
  expect_refused("name = \"drop\"\nbody = \"drop\"\nat = [0, 0]\n", "is the name of a body");
  expect_refused("name = \"a b\"\nbody = \"drop\"\nat = [0, 0]\n", "name");
  expect_refused("name = \"\"\nbody = \"drop\"\nat = [0, 0]\n", "name: is empty");
  expect_refused("name = \"p\"\nbody = \"dorp\"\nat = [0, 0]\n", "did you mean 'drop'?");
  expect_refused(p + "at = [0, 0]\n[[probe]]\n" + p + "at = [0, 0]\n", "there is a [[probe]]");
}

}  // namespace
}  // namespace meniscus::test_probe
