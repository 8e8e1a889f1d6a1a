// SPDX-License-Identifier: BSD-3-Clause
// Sharp contact lines: walls, profiles of Young and Laplace, drops at rest and in motion.
#include "body/surface/surface_patches.hpp"
#include "body/surface/wetted_points.hpp"
#include "cases.hpp"
#include "input_scene.hpp"
#include "measure/young_laplace.hpp"
#include "meniscus/error.hpp"
#include "run/simulation.hpp"
#include "support.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <numbers>

namespace meniscus::test_sharp_line {
namespace {

constexpr Real degree = std::numbers::pi / 180;

std::vector<Vec<3>> points_on(const std::function<Vec<3>(Real, Real)>& surface) {
  std::vector<Vec<3>> points;
  for (int i = 0; i < 7; ++i)
    for (int k = 0; k < 6; ++k) points.push_back(surface(0.3 * i - 0.8, 0.25 * k - 0.5));
  return points;
}

TEST(WettedWall, IsFoundFromThePointsOfAFace) {
  const auto plane = wall_through<3>(
      points_on([](Real a, Real b) { return Vec<3>(a, b, 0.3 * a - 0.1 * b + 2); }), std::nullopt);
  ASSERT_TRUE(plane);
  EXPECT_TRUE(plane->is_plane());
  const auto ball = wall_through<3>(
      points_on([](Real a, Real b) { return Vec<3>(1 + a, b, std::sqrt(9 - a * a - b * b) - 5); }),
      std::nullopt);
  ASSERT_TRUE(ball);
  EXPECT_NEAR(ball->radius(), 3, 1e-9);
  EXPECT_NEAR((ball->point() - Vec<3>(1, 0, -5)).norm(), 0, 1e-9);
  const auto bent = points_on([](Real a, Real b) { return Vec<3>(a, b, std::sqrt(4 - a * a)); });
  EXPECT_FALSE(wall_through<3>(bent, std::nullopt)) << "a cylinder is no ball";
  const auto cylinder = wall_through<3>(bent, Vec<3>(0, 1, 0));
  ASSERT_TRUE(cylinder);
  EXPECT_NEAR(cylinder->radius(), 2, 1e-9);
  EXPECT_FALSE(
      wall_through<3>(points_on([](Real a, Real b) { return Vec<3>(a, b, a * b); }), std::nullopt));
  EXPECT_FALSE(wall_through<3>({}, std::nullopt));
}

/// P(y) lies on the wall, and project() is the derivative of P.
void expect_projection(const WettedWall<3>& wall) {
  const std::array<Real, 3> y{0.4, -0.7, 0.9}, dy{0.3, 0.2, -0.5};
  const auto foot = wall.foot<Real>(y);
  EXPECT_NEAR(wall.foot<Real>(foot.x).distance, 0, 1e-12);
  const auto along = wall.project<Real>(foot, dy);
  std::array<Dual<Real>, 3> moving;
  for (std::size_t i = 0; i < 3; ++i) moving[i] = {y[i], dy[i]};
  const auto change = wall.foot<Dual<Real>>(moving);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(change.x[i].d, along[i], 1e-14);
    constexpr Real e = 1e-5;
    std::array<Real, 3> up = y, down = y;
    for (std::size_t k = 0; k < 3; ++k) up[k] += e * dy[k], down[k] -= e * dy[k];
    EXPECT_NEAR((wall.foot<Real>(up).x[i] - wall.foot<Real>(down).x[i]) / (2 * e), along[i], 1e-9);
  }
}

TEST(WettedWall, MovesPointsToTheNearestOne) {
  expect_projection(WettedWall<3>::plane({0.1, 0, -1}, Vec<3>(1, 2, -2) / 3));
  expect_projection(WettedWall<3>::ball({0.5, 0.1, -2}, 1.7));
  expect_projection(WettedWall<3>::ball({0.5, 0.1, -2}, 6));  // a cavity around the point
  expect_projection(WettedWall<3>::cylinder({0, 0, -2}, Vec<3>(2, 1, 2) / 3, 1.2));
}

TEST(WettedPoints, HaveTheAreaOfTheFaceAndALineAroundIt) {
  HalfSphere shape;
  shape.core = 4;
  shape.layers = 2;
  const Geometry<3> geometry = shape.geometry();
  const WettedPoints<3> points(geometry, "flat");
  Real area = 0, length = 0;
  for (const Real a : points.area) area += a;
  EXPECT_NEAR(area, std::numbers::pi, 1e-3);
  for (const LinePart<3>& part : points.line) {
    for (const Index q : part.point) EXPECT_NEAR(at(points.X, q).norm(), 1, 1e-12);
    EXPECT_LT(at(points.X, part.behind).norm(), 1);
    length += (at(points.X, part.point[0]) - at(points.X, part.point[1])).norm() +
              (at(points.X, part.point[1]) - at(points.X, part.point[2])).norm();
  }
  EXPECT_NEAR(length, 2 * std::numbers::pi, 0.02);  // of chords
}

TEST(YoungLaplace, AgreesWithTheReference) {
  const auto reference =
      nlohmann::json::parse(std::ifstream(MENISCUS_TEST_DATA "/young_laplace.json"));
  const Real volume = 4 * std::numbers::pi / 3;
  for (const auto& drop : reference.at("drops")) {
    const Real theta = drop.at("degrees").get<Real>() * degree, bond = drop.at("bond");
    SCOPED_TRACE(fmt::format("{} degrees, Bond {}", drop.at("degrees").get<Real>(), bond));
    const auto profile = profile_with<3>(theta, volume, bond);
    const Real a = drop.at("base_radius"), h = drop.at("height"), E = drop.at("energy");
    EXPECT_NEAR(profile.base_radius, a, 1e-8 * a);
    EXPECT_NEAR(profile.height, h, 1e-8 * h);
    EXPECT_NEAR(profile.free_area - std::cos(theta) * std::numbers::pi * a * a +
                    bond * volume * profile.centroid,
                E, 1e-8 * E);
    EXPECT_NEAR(profile_on<3>(a, volume, bond).contact_angle, theta, 1e-8);
  }
}

TEST(YoungLaplace, KnowsSegmentsInThePlane) {
  for (const Real theta : {0.3, 1.2, 2.4}) {
    const Real R = 1.7, a = R * std::sin(theta),
               area = R * R * (theta - std::sin(theta) * std::cos(theta));
    EXPECT_NEAR(profile_on<2>(a, area, 0).contact_angle, theta, 1e-9);
    EXPECT_NEAR(profile_with<2>(theta, area, 0).height, R * (1 - std::cos(theta)), 1e-9);
  }
}

TEST(YoungLaplace, HasNoProfileWhereADropFalls) {
  EXPECT_TRUE(std::isnan(profile_with<3>(90 * degree, 4 * std::numbers::pi / 3, -1).height));
  EXPECT_TRUE(std::isnan(profile_on<3>(0, 1, 0).height));
  EXPECT_TRUE(std::isnan(profile_on<3>(1, std::nan(""), 0).height));
}

Real measure_of(const auto& scene, const std::string& name, const Motion& motion) {
  for (const MeasureSource& source : scene.measures)
    if (source.name == name) return source.compute(motion);
  throw std::logic_error("no measure " + name);
}

/// A plane drop on a wall, with these further tables.
std::string plane_drop(Real angle, Real end, const std::string& lines,
                       const std::string& of_wall = "") {
  return fmt::format(
      "dimension = 2\n[time]\nviscosity = \"implicit\"\nend = {}\n[[body]]\nname = \"drop\"\n"
      "shape = \"cap\"\nradius = 1\ncontact_angle = {}\ncore = 8\nrings = 4\n"
      "{}"
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n[[wetted]]\nname = \"wall\"\n"
      "body = \"drop\"\nface = \"flat\"\n{}",
      end, angle,
      "material = { type = \"newtonian\", density = 1, bulk_modulus = 60, viscosity = 1 }\n" +
          lines,
      of_wall);
}

Simulation<2> run_to_end(Scene<2>& scene) {
  Simulation<2> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  return simulation;
}

TEST(SharpLine, ComesToTheAngleOfYoung) {
  Scene<2> scene = test::scene_of<2>(plane_drop(90, 8, "", "contact_angle = 75\n"));
  const Simulation<2> simulation = run_to_end(scene);
  EXPECT_NEAR(measure_of(scene, "wall.contact_angle", simulation.state().motion()), 75, 0.02);
}

TEST(SharpLine, StandsTheSameOnATiltedWall) {
  std::vector<Real> heights;
  for (const Real turn : {0.0, 40.0}) {
    Scene<2> scene = test::scene_of<2>(
        plane_drop(90, 2, fmt::format("rotate = {}\n", turn), "tension = -0.3\n") +
        fmt::format("[[body_force]]\nbody = \"drop\"\nacceleration = [{}, {}]\n",
                    0.5 * std::sin(turn * degree), -0.5 * std::cos(turn * degree)));
    const Simulation<2> simulation = run_to_end(scene);
    heights.push_back(measure_of(scene, "wall.height", simulation.state().motion()));
  }
  EXPECT_NEAR(heights[1], heights[0], 1e-5);  // the steps differ
}

TEST(SharpLine, WallsTakeTheWeight) {
  Scene<2> scene = test::scene_of<2>(plane_drop(90, 8, "", "contact_angle = 90\n") +
                                     "[[body_force]]\nbody = \"drop\"\nacceleration = [0, -0.5]\n");
  const Simulation<2> simulation = run_to_end(scene);
  const Motion motion = simulation.state().motion();
  const Real weight = 0.5 * std::numbers::pi;
  EXPECT_NEAR(measure_of(scene, "wall.force_y", motion), -weight, 1e-3 * weight);
  EXPECT_NEAR(measure_of(scene, "wall.force_x", motion), 0, 1e-9);
}

/// zeta v = gamma (cos theta - cos theta_line), if friction is so strong that the drop is always
/// near a segment of a circle.
TEST(SharpLine, FrictionSetsTheSpeedOfTheLine) {
  constexpr Real zeta = 200;
  Scene<2> scene = test::scene_of<2>(
      plane_drop(90, 3, "", fmt::format("contact_angle = 60\nline_friction = {}\n", zeta)));
  const Simulation<2> simulation = run_to_end(scene);
  const Motion motion = simulation.state().motion();
  const Real speed = measure_of(scene, "wall.line_speed", motion),
             angle = measure_of(scene, "wall.contact_angle", motion);
  EXPECT_NEAR(zeta * speed / (std::cos(60 * degree) - std::cos(angle * degree)), 1, 0.01);
  EXPECT_GT(speed, 0);
}

/// A plane bridge between plates that part and come back slowly: the force depends on the distance
/// alone, and the work of the plates is booked.
TEST(SharpLine, PlatesThatMoveDoWork) {
  Scene<2> scene = test::scene_of<2>(
      "dimension = 2\n[time]\nviscosity = \"implicit\"\nend = 60\n[[body]]\nname = \"drop\"\n"
      "shape = \"rectangle\"\ncorner = [-1, 0]\nsize = [2, 1]\ncells = [8, 5]\n"
      "material = { type = \"newtonian\", density = 0.1, bulk_modulus = 30, viscosity = 0.3 }\n"
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n[[wetted]]\nname = \"below\"\n"
      "body = \"drop\"\nface = \"y_min\"\ncontact_angle = 70\n[[wetted]]\nname = \"above\"\n"
      "body = \"drop\"\nface = \"y_max\"\ncontact_angle = 70\n"
      "displacement = [0, \"0.1*sin(pi/40*max(t - 20, 0))\"]\n");
  Simulation<2> simulation(scene);
  simulation.begin();
  Real forth = 0;
  const auto force = [&](const std::string& of) {
    return measure_of(scene, of + ".force_y", simulation.state().motion());
  };
  while (!simulation.finished()) {
    simulation.advance();
    if (forth == 0 && simulation.state().time > 30) forth = force("above");
    if (simulation.state().time > 50) break;
  }
  EXPECT_LT(forth, -0.5);
  EXPECT_NEAR(force("above") / forth, 1, 0.02);
  EXPECT_NEAR(force("below"), -force("above"), 1e-3);
  const State& state = simulation.state();
  EXPECT_GT(state.books.external_work, 0.01);
  EXPECT_NEAR(simulation.audit().balance_error(simulation.audit_now()), 0, 2e-3);
  EXPECT_NEAR(measure_of(scene, "below.base_radius", state.motion()),
              measure_of(scene, "above.base_radius", state.motion()), 1e-3);
}

std::string message_of(const std::string& scene) {
  try {
    test::scene_of<2>(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SharpLine, ProblemsOfScenesAreNamed) {
  const auto expect = [](const std::string& scene, const std::string& words) {
    EXPECT_NE(message_of(scene).find(words), std::string::npos) << message_of(scene);
  };
  const std::string good = plane_drop(90, 1, "", "contact_angle = 60\n");
  EXPECT_EQ(message_of(good), "");
  expect(plane_drop(90, 1, "", ""), "contact_angle: missing; give this or tension");
  expect(plane_drop(90, 1, "", "contact_angle = 60\ntension = 0.2\n"), "tension is given, too");
  expect(plane_drop(90, 1, "", "contact_angle = 180\n"), "between 0 and 180");
  expect(plane_drop(90, 1, "", "tension = -1.5\n"), "no contact angle exists");
  expect(plane_drop(90, 1, "map = [\"x\", \"y + 0.1*x^4\"]\n", "contact_angle = 60\n"),
         "lies on no plane or ball");
  expect(good + "[[remap]]\nbody = \"drop\"\nat = [0.5]\n", "wetted face");
  std::string other = good;
  other.replace(other.find("face = \"flat\""), 13, "face = \"base\"");
  expect(other, "has no face 'base'");
  other = good;
  other.replace(other.find("gamma = 1"), 9, "gamma = 1\nform = \"weak\"");
  expect(other, "no [[surface_tension]] of its whole surface");
  expect(plane_drop(90, 1, "", "contact_angle = 60\ndisplacement = [0, \"x\"]\n"), "displacement");
  const std::string box =
      "dimension = 2\n[time]\nend = 1\n[[body]]\nname = \"drop\"\nshape = \"rectangle\"\n"
      "size = [1, 1]\ncells = [6, 6]\n" +
      example_liquid() + "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n";
  expect(box + "[[wetted]]\nbody = \"drop\"\nface = \"x_min\"\ncontact_angle = 60\n" +
             "[[wetted]]\nbody = \"drop\"\nface = \"y_min\"\ncontact_angle = 60\n",
         "have points in common");
  expect(good + "[[surface_tension]]\nbody = \"drop\"\nface = \"round\"\ngamma = 1\n",
         "has a tension already");
}

/// Faces with tensions of their own: the sum of both is the tension of the whole.
TEST(FaceTension, OfAllFacesIsThatOfTheWhole) {
  const std::string body = "dimension = 3\n[time]\nend = 1\n" + sessile_drop(3);
  const std::string drop = body.substr(0, body.find("[[surface_tension]]"));
  Scene<3> whole = test::scene_of<3>(
               drop + "[[surface_tension]]\nbody = \"drop\"\ngamma = 2\ncoefficient_damping = 0\n"),
           parts = test::scene_of<3>(
               drop +
               "[[surface_tension]]\nbody = \"drop\"\nface = \"flat\"\ngamma = 2\n"
               "[[surface_tension]]\nbody = \"drop\"\nface = \"round\"\ngamma = 2\n");
  const NodalVectors u = test::random_field<3>(whole.system.bodies[0].size(), 0.02, 5), v(u.size());
  const Motion motion{0, u, v};
  Real sum = 0;
  for (const auto& term : parts.system.terms)
    if (term->energy_kind() == "surface") sum += *term->stored_energy(motion);
  Real all = 0;
  for (const auto& term : whole.system.terms)
    if (term->energy_kind() == "surface") all += *term->stored_energy(motion);
  // The whole has the area of the exact surface in the reference.
  EXPECT_NEAR(sum, all, 1e-4 * all);
  EXPECT_GT(sum, 0);
}

}  // namespace
}  // namespace meniscus::test_sharp_line
