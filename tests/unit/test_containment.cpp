// SPDX-License-Identifier: BSD-3-Clause
// Bodies inside each other are detected at the start and during runs; bodies that only touch are
// not.
#include "contact_support.hpp"
#include "meniscus/error.hpp"
#include "physics/contact/points/containment.hpp"
#include "run/simulation.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

template <class Shape>
auto shell(Real radius, Real thickness) {
  Shape shape;
  shape.radius = radius;
  shape.thickness = thickness;
  shape.layers = 2;
  shape.spacing = 0.3;
  return test::with_mass(shape.geometry());
}

template <int D>
Real winding_number(const Body<D>& body, const Vec<D>& x) {
  const NodalVectors still(static_cast<std::size_t>(body.size()), Lanes::zero());
  const Motion motion{0, still, still};
  return Polyhedron<D>(PlacedBody<D>(body, motion)).winding_number(x);
}

TEST(Containment, WindingNumbersKnowCavities) {
  const auto disk = test::with_mass<2>(test::disk(4, 2));
  const auto ball = test::with_mass<3>(test::ball(4, 2));
  const auto hollow = shell<SphereShell>(1, 0.4);
  for (const Real r : {0.0, 0.5, 0.9}) {
    EXPECT_NEAR(winding_number<2>(*disk, {r, 0.1}), 1, 1e-12);
    EXPECT_NEAR(winding_number<3>(*ball, {r, 0.1, 0.2}), 1, 1e-12);
  }
  EXPECT_NEAR(winding_number<3>(*hollow, {0.8, 0, 0}), 1, 1e-12);
  for (const Real r : {0.0, 0.4, 1.3, 7.0})
    EXPECT_NEAR(winding_number<3>(*hollow, {0, r, 0}), 0, 1e-12);
}

/// The failure of two balls (2D: disks) that are `distance` apart after the motion.
template <int D>
std::optional<Failure> balls_at(Real distance) {
  const auto pair = test::round_pair<D>(0.5);
  const NodalVectors u = pair.field([&](const Vec<D>& X) {
    // The second ball, which lies mainly along the first axis, moves to (distance, 0, 0), rotated.
    Vec<D> centre = Vec<D>::Constant(0.3);
    centre[0] = 1;
    centre *= 2.5 / centre.norm();
    if ((X - centre).norm() > 1 + 1e-9) return Vec<D>(Vec<D>::Zero());
    const Vec<D> arm = X - centre;
    Vec<D> x = arm;
    x[0] = 0.8 * arm[0] - 0.6 * arm[1] + distance;
    x[1] = 0.6 * arm[0] + 0.8 * arm[1];
    return Vec<D>(x - X);
  });
  const NodalVectors v = test::zeros(u);
  return body_inside(*pair.first, *pair.second, {0, u, v});
}

template <int D>
void expect_balls_found() {
  for (const Real distance : {2.5, 2.05, 2.0, 1.99, -2.01})
    EXPECT_FALSE(balls_at<D>(distance)) << distance;
  for (const Real distance : {1.5, 1.0, 0.4, 0.0, -1.4}) {
    const auto found = balls_at<D>(distance);
    ASSERT_TRUE(found) << distance;
    EXPECT_NE(found->cause.find("is inside of body"), std::string::npos) << found->cause;
  }
}

TEST(Containment, OverlappingBallsAreFoundAndTouchingOnesAreNot) {
  expect_balls_found<2>();
  expect_balls_found<3>();
}

/// The ball fills the cavity exactly, but flat simplices of the cavity reach into the ball.
TEST(Containment, ABallMayFillACavity) {
  auto hollow = shell<SphereShell>(1.4, 0.4);
  auto ball = test::with_mass<3>(test::ball(4, 2), hollow->size());
  NodalVectors u(static_cast<std::size_t>(hollow->size() + ball->size()), Lanes::zero());
  const NodalVectors v = u;
  EXPECT_FALSE(body_inside(*hollow, *ball, {0, u, v}));
  for (Index A = 0; A < ball->size(); ++A) at(u, ball->first + A) = Lanes(0.25, 0, 0, 0);
  EXPECT_TRUE(body_inside(*hollow, *ball, {0, u, v}));
}

std::string disk(const std::string& name, Real radius, const std::string& more, int core = 4) {
  return "[[body]]\nname = \"" + name + "\"\nshape = \"disk\"\nradius = " + std::to_string(radius) +
         "\ncore = " + std::to_string(core) + "\nrings = " + std::to_string(core / 2) + "\n" +
         more + "\nmaterial = { type = \"neo_hookean\", density = 1, mu = 400, lambda = 300 }\n";
}

/// The message with which a scene of disks ends; "" if it runs to its end.
std::string end_of(const std::string& bodies, const std::string& contact) {
  const std::string text =
      "dimension = 2\n[time]\nend = 0.4\n" + bodies + "[[contact]]\nname = \"contact\"\n" + contact;
  try {
    const SceneInput input = SceneInput::from_text(text);
    scene_dimension(input);
    Scene<2> scene = build_scene<2>(input);
    Simulation<2> simulation(scene);
    simulation.begin();
    for (int k = 0; !simulation.finished(); ++k) {
      simulation.advance();
      if (k % 5 == 0) simulation.audit_now();
    }
    simulation.audit_now();
  } catch (const InputError& e) {
    return std::string("refused: ") + e.what();
  } catch (const SolveError& e) {
    return std::string("stopped: ") + e.what();
  }
  return "";
}

void expect_end(const std::string& end, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(end.find(word), std::string::npos) << end;
}

const std::string thrown = disk("one", 0.4, "centre = [-1.6, 0.07]\ninitial_velocity = [3, 0]"),
                  target = disk("two", 1, "");
const std::string both = "bodies = [\"one\", \"two\"]\nepsilon = 1\nbeta = 1\n";

TEST(Containment, AStartInsideIsRefused) {
  expect_end(end_of(disk("one", 0.4, "centre = [0.1, 0]") + target, both + "sigma0 = 0.1\n"),
             {"refused: ", "contact[0]", "body 'one', particle", "is inside of body 'two'",
              "move the bodies apart"});
  expect_end(end_of(target,
                    "bodies = [\"two\"]\nepsilon = 1\nsigma0 = 0.02\nbeta = 1\npartner = { "
                    "type = \"ball\", centre = [0.1, 0], radius = 0.02 }\n"),
             {"refused: ", "contact[0]", "body 'two', particle", "rigid partner", "is inside"});
}

TEST(Containment, PointsThatMissEachOtherAreRefused) {
  expect_end(end_of(thrown + target, both + "sigma0 = 0.001\npoints = 2\n"),
             {"refused: ", "contact[0]", "'one' and 'two'", "go through each other",
              "allowed are distances"});
}

/// The repulsion is far too weak and acts between points that miss each other.
TEST(Containment, ABodyThatWentThroughTheSurfaceIsStopped) {
  expect_end(end_of(disk("one", 1, "centre = [-1.2, 0]\ninitial_velocity = [1.5, 0]", 6) +
                        disk("two", 1, "centre = [1.2, 0.3]\ninitial_velocity = [-1.5, 0]", 6),
                    both + "sigma0 = 0.05\npoints = 2\n"),
             {"stopped: step ", "particle", "body 'one'", "body 'two'"});
  expect_end(end_of(thrown,
                    "bodies = [\"one\"]\nepsilon = 1e-3\nsigma0 = 0.01\nbeta = 1\npartner = "
                    "{ type = \"ball\", centre = [-0.9, 0.15], radius = 0.01 }\n"),
             {"stopped: step ", "body 'one', particle", "rigid partner", "is inside"});
}

/// At any speed, no step carries a body through the range of another.
TEST(Containment, StepsFollowTheSpeedOfApproach) {
  const auto pair = test::round_pair<2>(5);
  const auto term = test::contact_of<2>(pair, test::law<2>(), ContactForm::energy);
  const NodalVectors still = test::zeros(pair.random(1, 1));
  const auto longest = [&](Real speed, Real common) {
    NodalVectors v = still;
    for (std::size_t A = 0; A < v.size(); ++A)
      v[A] =
          Lanes(common + (A < static_cast<std::size_t>(pair.first->size()) ? speed : 0), 0, 0, 0);
    return test::report_of(*term, still, v).demand.longest;
  };
  const Real reach = 2;  // 4 sigma0
  EXPECT_GT(longest(1, 0), 0.25 * reach);
  EXPECT_LT(longest(1, 0), 5 - 0.7 * reach);
  EXPECT_NEAR(longest(1000, 0), 1e-3 * longest(1, 0), 1e-12);
  EXPECT_NEAR(longest(1, 1e6), longest(1, 0), 1e-6);
  EXPECT_EQ(longest(0, 1e6), StepDemand{}.longest);
}

}  // namespace
}  // namespace meniscus
