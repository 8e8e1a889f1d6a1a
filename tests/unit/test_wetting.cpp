// SPDX-License-Identifier: BSD-3-Clause
// Young's law as an interaction, and the contact angle of a cap from its volume and height.
#include "input_scene.hpp"
#include "io_helpers.hpp"
#include "measure/wetting_measures.hpp"
#include "meniscus/error.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "physics/contact/bent_line.hpp"
#include "physics/contact/contact_numbers.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <numbers>

namespace meniscus::test_wetting {
namespace {

constexpr Real pi = std::numbers::pi, degree = pi / 180;

std::unique_ptr<ContactModel<3>> model(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  return interactions<3>().at("smooth_young").read(input.root());
}

TEST(SmoothYoung, HasTheAdhesionOfTheAngle) {
  for (const Real theta : {30.0, 90.0, 150.0}) {
    const auto law = model("contact_angle = " + std::to_string(theta));
    const PlaneContact flat = law->law({"", 0.2, 0.07})->flat();
    EXPECT_NEAR(flat.adhesion, 0.07 * (1 + std::cos(theta * degree)), 1e-15);
    EXPECT_NEAR(*contact_angle(flat.adhesion, 0.07) / degree, theta, 1e-10);
  }
}

TEST(SmoothYoung, TakesTheAngleInItsUnit) {
  for (const char* angle : {"120", "'120 deg'", "'2.0943951023931953 rad'"})
    EXPECT_NEAR(model(std::string("contact_angle = ") + angle)->law({"", 0.2, 2})->flat().adhesion,
                1, 1e-14)
        << angle;
}

TEST(SmoothYoung, TakesItsLengthsFromTheFacets) {
  const PlaneContact flat = model("adhesion = 2")->law({"", 0.2, std::nullopt})->flat();
  EXPECT_DOUBLE_EQ(flat.equilibrium_gap, 0.05);
  EXPECT_DOUBLE_EQ(flat.peak_gap, 0.1);
  EXPECT_DOUBLE_EQ(flat.peak_traction, 1.875 * 2 / 0.1);
  // The largest -K of a smooth step, 10/sqrt(3) W/range^2.
  EXPECT_NEAR(flat.softening, 10 / std::sqrt(3.0) * 2 / (0.1 * 0.1), 1e-10);
}

TEST(SmoothYoung, DoubtsARangeBelowAThirdOfAFacet) {
  const auto law = model("adhesion = 1\nrange = 0.1")->law({"", 0.3, 1});
  EXPECT_FALSE(law->doubt(0.3));
  EXPECT_NE(law->doubt(0.31)->find("contact line"), std::string::npos);
}

TEST(SmoothYoung, AnAngleNeedsASurfaceTension) {
  EXPECT_THROW_WITH(model("contact_angle = 60")->law({"a.toml:3:1", 0.2, std::nullopt}), InputError,
                    "a.toml:3:1: contact_angle needs the surface tension");
}

/// The law on a rigid partner, without offset, for a drop of surface tension 1 whose sharp line has
/// this radius.
std::shared_ptr<const Interaction> on_wall(const std::string& text, Real degrees, Real radius,
                                           int dimension = 3) {
  ContactSurfaces surfaces{"a.toml:3:1", 0.3, 1};
  surfaces.rigid = true;
  surfaces.dimension = dimension;
  surfaces.volume = std::pow(radius / base_of_cap(degrees * degree, dimension), dimension);
  return model("contact_angle = " + std::to_string(degrees) + "\n" + text)->law(surfaces);
}

TEST(BentLine, AgreesWithMeridiansOfSciPy) {
  const nlohmann::json cases =
      nlohmann::json::parse(std::ifstream(MENISCUS_TEST_DATA "/bent_line.json"));
  for (const auto& drop : cases) {
    const Real degrees = drop["angle"], range = drop["range"], radius = drop["radius"];
    const int dimension = drop["dimension"];
    const std::string of = fmt::format("{}D, {} degrees, range {}", dimension, degrees, range);
    const auto law = on_wall(fmt::format("range = {:.17g}", range), degrees, radius, dimension);
    const Real W = 1 + std::cos(degrees * degree),
               volume = std::pow(radius / base_of_cap(degrees * degree, dimension), dimension);
    const BentLine line = bent_line(*law, W, 1, volume, dimension);
    EXPECT_NEAR(line.radius, radius, 1e-9) << of;
    EXPECT_NEAR(line.depth, Real(drop["depth"]), 5e-5 * range) << of;
    EXPECT_NEAR(line.beyond, Real(drop["beyond"]), 2e-4 * range) << of;
    // The film rests by this depth above the wall.
    EXPECT_NEAR(law->flat().equilibrium_gap - law->recess(), line.depth, 1e-12) << of;
  }
}

/// For large drops the depth is INT (1 - sin phi/sin theta) dh (wetting note 12).
TEST(BentLine, HasTheDepthOfAStraightLineInLargeDrops) {
  for (const auto& [degrees, depth] :
       {std::pair(15.0, -1.3114), std::pair(30.0, -0.2965), std::pair(60.0, 0.1651),
        std::pair(90.0, 0.2953), std::pair(120.0, 0.3484), std::pair(165.0, 0.3766)}) {
    const auto law = on_wall("range = 1", degrees, 1000);
    EXPECT_NEAR(law->flat().equilibrium_gap - law->recess(), depth, 5e-3) << degrees;
  }
}

/// At the wall the drop has the angle of the modified Young law, cos theta - tau/(gamma r).
TEST(BentLine, ALineTensionShiftsTheWall) {
  const auto law = on_wall("range = 0.05\nline_tension = 0.1", 90, 1.26);
  const Real volume = std::pow(1.26 / base_of_cap(90 * degree, 3), 3);
  const BentLine line = bent_line(*law, 1, 1, volume, 3);
  const Real theta = std::acos(-0.1 / line.radius);
  EXPECT_NEAR(line.radius, base_of_cap(theta, 3) * std::cbrt(volume), 1e-9);
  // Where the line has no tension, the same sphere has 90 degrees, deeper by -cos theta x its
  // radius.
  const auto without = on_wall("range = 0.05", 90, line.radius / std::sin(theta));
  EXPECT_NEAR(line.depth - 0.1 / std::sin(theta),
              without->flat().equilibrium_gap - without->recess(), 1e-6);
  EXPECT_THROW_WITH(model("adhesion = 1\nline_tension = 0.1")->law({"a.toml:3:1", 0.3, 1}),
                    InputError, "a.toml:3:1: line_tension is for drops");
}

TEST(SmoothYoung, RestsAtAnyOffsetFromARigidPartner) {
  for (const Real offset : {-0.1, 0.0, 0.03, 0.3}) {
    const auto law = on_wall(fmt::format("range = 0.2\noffset = {}", offset), 90, 1.3);
    const PlaneContact flat = law->flat();
    EXPECT_NEAR(flat.equilibrium_gap - law->recess(), offset, 1e-15);
    EXPECT_NEAR(law->at(flat.equilibrium_gap).pressure, 0, 1e-14);
    EXPECT_GT(law->least_gap(), 0);
    EXPECT_GT(law->at(law->least_gap()).energy, 0.5) << "the core withstands a fall into the well";
  }
  EXPECT_THROW_WITH(model("adhesion = 1\noffset = -0.1")->law({"a.toml:3:1", 0.3, 1}), InputError,
                    "a.toml:3:1: offset is -0.1 between two bodies; allowed is > 0");
}

TEST(Wetting, AngleOfACap) {
  for (const Real theta : {20.0, 60.0, 90.0, 120.0, 170.0}) {
    const Real c = std::cos(theta * degree), s = std::sin(theta * degree), H = 1 - c;
    EXPECT_NEAR(angle_of_cap<3>(pi / 3 * (2 + c) * H * H, H) / degree, theta, 1e-9);
    EXPECT_NEAR(angle_of_cap<2>(theta * degree - s * c, H) / degree, theta, 1e-9);
  }
  EXPECT_EQ(angle_of_cap<3>(4 * pi / 3, 2.001), pi);
}

}  // namespace
}  // namespace meniscus::test_wetting
