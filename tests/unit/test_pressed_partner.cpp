// SPDX-License-Identifier: BSD-3-Clause
// Rigid partners that a force or a spring presses: their place, and runs with them.
#include "physics/contact/rigid/partner_press.hpp"
#include "solved.hpp"
#include "thrown.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meniscus::test_pressed_partner {
namespace {

/// A partner and a body that repels it by 2 exp(-2 z) and attracts it by 2 exp(-z), z = gap - 1.
struct Trial final : PartnerPress<2>::Neighbour {
  PartnerPress<2> press;
  Real distance = 8;  ///< of the body at the way 0
  int looks = 0;

  Trial(Real force, Real stiffness, Real base = 0)
      : press({{1, 0}, Expression(force), Expression(base), stiffness, {}}) {}
  Real gap() override { return distance - press.way(); }
  Real pull() override {
    ++looks;
    const Real z = gap() - 1;
    return 2 * std::exp(-2 * z) - 2 * std::exp(-z);
  }
  bool settle() { return press.settle(0, *this, 1, 1000); }
  Real left() {
    return pull() + press.stiffness() * (press.way() - press.base(0)) - press.force(0);
  }
};

TEST(PressedPartner, ComesToTheBodyFromFarAndStays) {
  Trial trial(3, 0);
  ASSERT_TRUE(trial.settle());
  EXPECT_NEAR(trial.left(), 0, 1e-11);
  EXPECT_LT(trial.distance - trial.press.way(), 1);
  EXPECT_GT(trial.distance - trial.press.way(), 0.3);
  trial.press.commit(0);
  trial.looks = 0;
  ASSERT_TRUE(trial.settle());
  EXPECT_EQ(trial.looks, 1);
}

TEST(PressedPartner, FollowsTheBodyInFewSteps) {
  Trial trial(3, 0);
  ASSERT_TRUE(trial.settle());
  trial.press.commit(0);
  const Real way = trial.press.way();
  trial.distance += 0.01;
  trial.looks = 0;
  ASSERT_TRUE(trial.settle());
  EXPECT_NEAR(trial.press.way(), way + 0.01, 1e-11);
  EXPECT_LE(trial.looks, 8);
}

TEST(PressedPartner, HangsOnAdhesionUntilThisGives) {
  Trial trial(0.4, 0);
  ASSERT_TRUE(trial.settle());
  trial.press.commit(0);
  const auto hangs = [&](Real force) {
    Trial next(force, 0);
    next.press.set_way(trial.press.way());
    next.press.commit(0);
    return next.settle() && std::abs(next.left()) < 1e-11;
  };
  EXPECT_TRUE(hangs(-0.49));  // the largest adhesion is 1/2
  EXPECT_FALSE(hangs(-0.51));
}

TEST(PressedPartner, ASpringJumpsInAndHolds) {
  // A soft spring jumps into contact where the slope of the adhesion is its stiffness. From far
  // away it rests in front of the body.
  Trial before(0, 0.01, 0.3);
  ASSERT_TRUE(before.settle());
  EXPECT_NEAR(before.left(), 0, 1e-12);
  EXPECT_GT(before.distance - before.press.way(), 1 + std::log(2 / 0.01));
  Trial after(0, 0.01, 7);
  ASSERT_TRUE(after.settle());
  EXPECT_NEAR(after.left(), 0, 1e-12);
  EXPECT_LT(after.distance - after.press.way(), 1.1);
}

TEST(PressedPartner, NothingInItsWayIsFound) {
  Trial trial(-1, 0);
  EXPECT_FALSE(trial.settle());
}

/// A disk between a floor and a lid.
std::string pressed_disk(const std::string& of_lid, const std::string& time) {
  return fmt::format(R"(dimension = 2
[time]
{}
[[body]]
name = "disk"
shape = "disk"
radius = 1
core = 3
rings = 2
[body.material]
type = "neo_hookean"
density = 1
mu = 1
lambda = 2
[[contact]]
name = "floor"
bodies = ["disk"]
epsilon = 10
sigma0 = 0.2
beta = 1
partner = {{ type = "half_space", point = [0, -1.13], normal = [0, 1] }}
[[contact]]
name = "lid"
bodies = ["disk"]
epsilon = 10
sigma0 = 0.2
beta = 1
partner = {{ type = "half_space", point = [0, 1.15], normal = [0, -1], {} }}
)",
                     time, of_lid);
}
const std::string by_newton = "solver = \"newton\"\nend = 1\nstep = 0.25\n";

TEST(PressedPartner, ALidWithAWeightRestsWhereALidThatMovedThereIsPushedByIt) {
  const std::string weight = "direction = [0, -1], force = 0.4, ramp = [0, 1]";
  test::Solved<2> pressed(pressed_disk(weight, by_newton));
  const Real way = pressed.measure("lid.way");
  EXPECT_GT(way, 0.05);
  EXPECT_NEAR(pressed.measure("lid.force_y"), -0.4, 1e-11);
  EXPECT_NEAR(pressed.measure("floor.force_y"), 0.4, 1e-8);
  EXPECT_EQ(pressed.measure("lid.displacement_y"), -way);
  EXPECT_LT(std::abs(pressed.simulation.audit().balance_error(pressed.ledger())), 5e-3);

  test::Solved<2> moved(
      pressed_disk(fmt::format("displacement = [0, \"-{:.17g}*t\"]", way), by_newton));
  EXPECT_NEAR(moved.measure("lid.force_y"), -0.4, 1e-7);

  test::Solved<2> relaxed(pressed_disk(
      weight, "solver = \"relax\"\nend = 200\nforce_tolerance = 1e-7\nshape_tolerance = 1e-7\n"));
  EXPECT_NEAR(relaxed.measure("lid.way"), way, 2e-6);
}

TEST(PressedPartner, ASpringBetweenBaseAndLidHasTheForceOfItsStretch) {
  test::Solved<2> pressed(
      pressed_disk("direction = [0, -1], stiffness = 2, base = \"0.4*t\"", by_newton));
  const Real way = pressed.measure("lid.way");
  EXPECT_NEAR(pressed.measure("lid.press"), 2 * (0.4 - way), 1e-14);
  EXPECT_NEAR(pressed.measure("lid.force_y"), -2 * (0.4 - way), 1e-11);
  EXPECT_GT(way, 0.02);
  EXPECT_LT(way, 0.38);
}

TEST(PressedPartner, MotionUnderAWeightKeepsTheBooks) {
  test::Solved<2> moving(
      pressed_disk("direction = [0, -1], force = 0.4, ramp = [0, 2]", "end = 3\n"));
  const Ledger ledger = moving.ledger();
  const Real scale = ledger.stored.at("strain") + ledger.kinetic;
  EXPECT_GT(scale, 1e-3);
  EXPECT_LT(std::abs(moving.simulation.audit().balance_error(ledger)), 1e-3);
  EXPECT_NEAR(moving.measure("lid.force_y"), -0.4, 1e-10);
}

TEST(PressedPartner, APartnerThatNothingStopsIsAFailureThatSaysSo) {
  try {
    test::Solved<2> pressed(pressed_disk("direction = [1, 0], force = 0.4", by_newton));
    FAIL() << "a plane that moves along itself is stopped by nothing";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("nothing stops the rigid partner of contact 'lid'"),
              std::string::npos)
        << error.what();
    EXPECT_EQ(std::string(error.what()).find("particle"), std::string::npos) << error.what();
  }
}

TEST(PressedPartner, ForcesThatItWouldNotFeelAreRefused) {
  const auto with = [](const std::string& interaction) {
    std::string text = pressed_disk("direction = [0, -1], force = 0.4", by_newton);
    const std::string usual = "epsilon = 10\nsigma0 = 0.2\nbeta = 1\n";
    return text.replace(text.rfind(usual), usual.size(), interaction);
  };
  EXPECT_NO_THROW(test::scene_of<2>(with("adhesion = 0.3\n")));
  EXPECT_THROW_WITH(test::scene_of<2>(with("adhesion = \"0.3 + 0.1*x\"\n")), InputError,
                    "adhesion by formulas go without a direction of the partner");
  EXPECT_THROW_WITH(test::scene_of<2>(with("adhesion = 0.3\nfriction = 1\n")), InputError,
                    "friction: goes without a direction");
}

/// Contact points on the patches of a surface tension.
TEST(PressedPartner, ADropCarriesAPlate) {
  const std::string tension = "[[surface_tension]]\nbody = \"disk\"\ngamma = 1\n";
  std::string text = pressed_disk("direction = [0, -1], force = 0.1", "end = 0.3\n");
  const std::string solid = "type = \"neo_hookean\"\ndensity = 1\nmu = 1\nlambda = 2\n";
  text.replace(text.find(solid), solid.size(),
               "type = \"newtonian\"\ndensity = 1\nbulk_modulus = 20\nviscosity = 0.5\n");
  test::Solved<2> drop(text + tension);
  EXPECT_NEAR(drop.measure("lid.force_y"), -0.1, 1e-10);
  EXPECT_LT(std::abs(drop.simulation.audit().balance_error(drop.ledger())), 1e-2);
}

}  // namespace
}  // namespace meniscus::test_pressed_partner
