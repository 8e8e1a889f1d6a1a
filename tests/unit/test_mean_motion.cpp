// SPDX-License-Identifier: BSD-3-Clause
// Measures of the motion of a body as a whole, against rigid bodies.
#include "meniscus/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meniscus::test_mean_motion {
namespace {

// A block of density 3 with sides 1, 2, 0.5 and mass 3.
const std::string block = R"toml(
dimension = 3
time = { end = 1 }
[[body]]
name = "block"
shape = "box"
size = [1, 2, 0.5]
cells = [4, 6, 3]
centre = [10, -20, 30]
material = { type = "neo_hookean", density = 3, mu = 3, lambda = 10 }
)toml";

/// Inertia of the block about its own axes x, y, z.
constexpr double inertia[] = {3 * (4 + 0.25) / 12, 3 * (1 + 0.25) / 12, 3 * (4 + 1) / 12.0};

TEST(MeanMotion, ARigidBodyThatFliesAndTurns) {
  // The velocity is v = V + omega x (X - c), V = (5, 6, 7), omega = (0.3, -0.2, 0.5).
  const meniscus::Run run = meniscus::Run::from_text(block + R"toml(initial_velocity = [
    "5 - 0.2*(z - 30) - 0.5*(y + 20)", "6 + 0.5*(x - 10) - 0.3*(z - 30)", "7 + 0.3*(y + 20) + 0.2*(x - 10)"])toml");
  const double V[] = {5, 6, 7}, omega[] = {0.3, -0.2, 0.5}, centre[] = {10, -20, 30};
  double energy = 0;
  for (int i = 0; i < 3; ++i) {
    const auto of = [&](const char* name) {
      return run.measure(std::string("block.") + name + "_" + "xyz"[i]);
    };
    EXPECT_NEAR(of("centre"), centre[i], 1e-12);
    EXPECT_NEAR(of("velocity"), V[i], 1e-12);
    EXPECT_NEAR(of("momentum"), 3 * V[i], 1e-11);
    EXPECT_NEAR(of("spin"), inertia[i] * omega[i], 1e-11);
    energy += (3 * V[i] * V[i] + inertia[i] * omega[i] * omega[i]) / 2;
  }
  EXPECT_NEAR(run.measure("block.kinetic_energy"), energy, 1e-10);
}

/// A box of side L has the same second moment L^2/12 as an ellipsoid with the full axis L
/// sqrt(5/3).
TEST(MeanMotion, PrincipalExtentsTurnWithTheBody) {
  const double factor = std::sqrt(5.0 / 3);
  // The body is rotated by 0.7 about z and moved; then stretched by 1.5 along x.
  for (const char* moved : {"initial_displacement = [0, 0, 0]",
                            R"toml(initial_displacement = [
    "cos(0.7)*(x - 10) - sin(0.7)*(y + 20) - x", "sin(0.7)*(x - 10) + cos(0.7)*(y + 20) - y", 5])toml",
                            R"toml(initial_displacement = ["0.5*x", 0, 0])toml"}) {
    const meniscus::Run run = meniscus::Run::from_text(block + moved);
    const double along_x = std::string(moved).find("0.5*x") == std::string::npos ? 1 : 1.5;
    EXPECT_NEAR(run.measure("block.principal_extent_1"), 2 * factor, 1e-11) << moved;
    EXPECT_NEAR(run.measure("block.principal_extent_2"), along_x * factor, 1e-11) << moved;
    EXPECT_NEAR(run.measure("block.principal_extent_3"), 0.5 * factor, 1e-11) << moved;
  }
}

const std::string sheet = R"toml(
dimension = 2
time = { end = 1 }
[[body]]
name = "sheet"
shape = "rectangle"
size = [1, 2]
cells = [5, 10]
material = { type = "neo_hookean", density = 3, mu = 3, lambda = 10 }
)toml";

TEST(MeanMotion, ASheetTurnsAboutZ) {
  const meniscus::Run run =
      meniscus::Run::from_text(sheet + R"toml(initial_velocity = ["4 - 0.5*y", "0.5*x"])toml");
  EXPECT_NEAR(run.measure("sheet.spin_z"), 0.5 * 6 * (1 + 4) / 12, 1e-12);
  EXPECT_NEAR(run.measure("sheet.momentum_x"), 24, 1e-11);
  EXPECT_NEAR(run.measure("sheet.kinetic_energy"), 6 * 16 / 2.0 + 0.25 * 6 * 5 / 24, 1e-11);
  EXPECT_NEAR(run.measure("sheet.principal_extent_1"), 2 * std::sqrt(4 / 3.0), 1e-12);
  EXPECT_NEAR(run.measure("sheet.principal_extent_2"), std::sqrt(4 / 3.0), 1e-12);
  const auto names = run.measures();
  EXPECT_EQ(std::count(names.begin(), names.end(), "sheet.spin_x"), 0);
}

/// The measures of the only body equal the momenta and the energy of the audit.
TEST(MeanMotion, IsThatOfTheAuditAndStaysWhereNothingActs) {
  meniscus::Run run = meniscus::Run::from_text(
      sheet + R"toml(initial_velocity = ["4 - 0.5*y*y", "0.5*x + 0.1*sin(3*y)"])toml");
  const double momentum = run.measure("sheet.momentum_x"), spin = run.measure("sheet.spin_z"),
               energy = run.measure("sheet.kinetic_energy"), begin = run.measure("sheet.centre_x");
  run.advance_to(0.3);
  EXPECT_NEAR(run.measure("sheet.momentum_x"), momentum, 1e-11 * momentum);
  EXPECT_NEAR(run.measure("sheet.spin_z"), spin, 1e-10);
  EXPECT_NEAR(run.measure("sheet.centre_x"), begin + momentum / 6 * run.time(), 1e-11);
  EXPECT_GT(std::abs(run.measure("sheet.kinetic_energy") - energy), 1e-6);  // it also deforms
}

/// The measures continue after a remap, up to the difference between new and old cells.
TEST(MeanMotion, OfADropThatIsReferredAnew) {
  meniscus::Run run = meniscus::Run::from_text(R"toml(
dimension = 2
time = { end = 0.2 }
[[body]]
name = "drop"
shape = "disk"
radius = 1
core = 4
rings = 2
initial_velocity = [3, "2 + 0.1*x"]
material = { type = "newtonian", density = 1, bulk_modulus = 20, viscosity = 0.3 }
[[remap]]
body = "drop"
at = [0.1]
)toml");
  const double spin = run.measure("drop.spin_z"), x = run.measure("drop.centre_x"),
               y = run.measure("drop.centre_y");
  run.advance_to(0.2);
  EXPECT_NEAR(run.measure("drop.centre_x"), x + 3 * run.time(), 1e-7);
  EXPECT_NEAR(run.measure("drop.centre_y"), y + 2 * run.time(), 1e-7);
  EXPECT_NEAR(run.measure("drop.spin_z"), spin, 1e-6);
}

}  // namespace
}  // namespace meniscus::test_mean_motion
