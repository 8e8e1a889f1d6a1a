// SPDX-License-Identifier: BSD-3-Clause
// Extents of bodies that are rotated by affine initial displacements.
#include "meniscus/run.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meniscus::test_shape_measures {
namespace {

/// A body about the origin, stretched by a along x and turned by an angle about z.
std::string turned(int dimension, const std::string& shape, double a, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return fmt::format(R"toml(
dimension = {}
time = {{ end = 1 }}
[[body]]
name = "body"
{}
material = {{ type = "neo_hookean", density = 1, mu = 1, lambda = 1 }}
initial_displacement = ["{:.17g}*x - ({:.17g}*y)", "{:.17g}*x + ({:.17g}*y)"{}]
)toml",
                     dimension, shape, a * c - 1, s, a * s, c - 1, dimension == 3 ? ", 0" : "");
}

/// The extents of a disk or ball of radius 1 that is stretched to an ellipse or ellipsoid are
/// 2 sqrt(a^2 cos^2 + sin^2) and 2 sqrt(a^2 sin^2 + cos^2) at any angle.
TEST(ShapeMeasures, ExtentsOfRoundBodiesThatTurnAreThoseOfTheirSurface) {
  const std::pair<int, std::string> bodies[] = {
      {2, "shape = \"disk\"\nradius = 1\ncore = 4\nrings = 2"},
      {3, "shape = \"ball\"\nradius = 1\ncore = 4\nlayers = 2"}};
  for (const auto& [dimension, shape] : bodies)
    for (const double a : {1.0, 1.5})
      for (const double angle : {0.0, 0.1, 0.2, 0.3, 0.7, 2.0}) {
        const meniscus::Run run = meniscus::Run::from_text(turned(dimension, shape, a, angle));
        const double c = std::cos(angle), s = std::sin(angle);
        EXPECT_NEAR(run.measure("body.extent_x"), 2 * std::hypot(a * c, s), 3e-4)
            << dimension << " " << a << " " << angle;
        EXPECT_NEAR(run.measure("body.extent_y"), 2 * std::hypot(a * s, c), 3e-4)
            << dimension << " " << a << " " << angle;
        if (dimension == 3) {
          EXPECT_NEAR(run.measure("body.extent_z"), 2, 1e-5);
        }
      }
}

/// Flat faces and corners: exact.
TEST(ShapeMeasures, ExtentsOfABoxThatTurnsAreThoseOfItsCorners) {
  for (const double angle : {0.0, 0.3, 0.7, 2.0}) {
    const meniscus::Run run = meniscus::Run::from_text(
        turned(3, "shape = \"box\"\nsize = [2, 1, 0.5]\ncells = [5, 3, 2]", 1, angle));
    const double c = std::abs(std::cos(angle)), s = std::abs(std::sin(angle));
    EXPECT_NEAR(run.measure("body.extent_x"), 2 * c + s, 1e-12) << angle;
    EXPECT_NEAR(run.measure("body.extent_y"), 2 * s + c, 1e-12) << angle;
    EXPECT_NEAR(run.measure("body.extent_z"), 0.5, 1e-12) << angle;
  }
}

}  // namespace
}  // namespace meniscus::test_shape_measures
