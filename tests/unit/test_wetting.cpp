// SPDX-License-Identifier: BSD-3-Clause
// Young's law as an interaction, and the contact angle of a cap from its volume and height.
#include "input_scene.hpp"
#include "io_helpers.hpp"
#include "measure/wetting_measures.hpp"
#include "meniscus/error.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "physics/contact/contact_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
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
    const PlaneContact flat = law->flat(true, {"", 0.2, 0.07});
    EXPECT_NEAR(flat.adhesion, 0.07 * (1 + std::cos(theta * degree)), 1e-15);
    EXPECT_NEAR(*contact_angle(flat.adhesion, 0.07) / degree, theta, 1e-10);
  }
}

TEST(SmoothYoung, TakesTheAngleInItsUnit) {
  for (const char* angle : {"120", "'120 deg'", "'2.0943951023931953 rad'"})
    EXPECT_NEAR(model(std::string("contact_angle = ") + angle)->flat(true, {"", 0.2, 2}).adhesion,
                1, 1e-14)
        << angle;
}

TEST(SmoothYoung, TakesItsLengthsFromTheFacets) {
  const PlaneContact flat = model("adhesion = 2")->flat(true, {"", 0.2, std::nullopt});
  EXPECT_DOUBLE_EQ(flat.equilibrium_gap, 0.05);
  EXPECT_DOUBLE_EQ(flat.peak_gap, 0.1);
  EXPECT_DOUBLE_EQ(flat.peak_traction, 1.875 * 2 / 0.1);
  // The largest -K of a smooth step, 10/sqrt(3) W/range^2.
  EXPECT_NEAR(flat.softening, 10 / std::sqrt(3.0) * 2 / (0.1 * 0.1), 1e-10);
}

TEST(SmoothYoung, DoubtsARangeBelowAThirdOfAFacet) {
  const auto law = model("adhesion = 1\nrange = 0.1");
  EXPECT_FALSE(law->doubt({"", 0.3, 1}));
  EXPECT_NE(law->doubt({"", 0.31, 1})->find("contact line"), std::string::npos);
}

TEST(SmoothYoung, AnAngleNeedsASurfaceTension) {
  EXPECT_THROW_WITH(model("contact_angle = 60")->flat(true, {"a.toml:3:1", 0.2, std::nullopt}),
                    InputError, "a.toml:3:1: contact_angle needs the surface tension");
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
