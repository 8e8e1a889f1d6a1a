// SPDX-License-Identifier: BSD-3-Clause
// Bodies of revolution in the half plane (axisymmetry note): rows at the axis, patch tests, masses,
// and what is not of revolution.
#include "body/shapes/half_plane.hpp"
#include "cases.hpp"
#include "kernel/row_sums.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace meniscus::test_axisymmetry {
namespace {

constexpr Real pi = std::numbers::pi;

std::string heading(const std::string& time = "end = 1\n") {
  return "dimension = \"axisymmetric\"\n[time]\n" + time;
}
std::string solid(const std::string& shape, Real lambda = 10) {
  return "[[body]]\nname = \"body\"\n" + shape +
         "material = { type = \"neo_hookean\", density = 2, mu = 3, lambda = " +
         std::to_string(lambda) + " }\n";
}
const std::string ball = "shape = \"disk\"\nradius = 1\ncore = 6\nrings = 3\njitter = 0.2\n",
                  cylinder =
                      "shape = \"rectangle\"\nsize = [1, 2]\nspacing = 0.25\n"
                      "centre = [0.5, 0.3]\njitter = 0.2\n";

/// Fields of the right parity, up to quadratic: across the axis x and x y, along it 1, y, x^2, y^2.
Vec<2> quadratic(const Vec<2>& X) {
  return {0.3 * X[0] + 0.2 * X[0] * X[1], 0.1 - 0.4 * X[1] + 0.7 * X[0] * X[0] - 0.2 * X[1] * X[1]};
}
/// Its gradient, with the stretch of circles at (2, 2).
Mat<3> gradient(const Vec<2>& X) {
  Mat<3> H = Mat<3>::Zero();
  H(0, 0) = H(2, 2) = 0.3 + 0.2 * X[1];
  H(0, 1) = 0.2 * X[0];
  H(1, 0) = 1.4 * X[0];
  H(1, 1) = -0.4 - 0.4 * X[1];
  return H;
}

TEST(Axisymmetry, RowsReproduceQuadraticsOfTheRightParityAtTheAxis) {
  for (const std::string& shape : {ball, cylinder}) {
    const Scene<2> scene = test::scene_of<2>(heading() + solid(shape));
    const Body<2>& body = scene.system.bodies.front();
    const NodalVectors f = test::field_on<2>(body, quadratic);
    const std::vector<Vec<2>> points = {{0, 0.1}, {1e-9, 0.2}, {0.03, -0.4}, {0.2, 0.3}, {0.7, 0}};
    const PointRows<2> rows =
        build_point_rows<2>(body.particles, points, {.value = true, .gradient = true}, body.name);
    for (Index q = 0; q < rows.size(); ++q) {
      const Vec<2> expected = quadratic(at(points, q));
      const Mat<3> H = gradient(at(points, q));
      const Lanes value = value_at(rows, q, f.data());
      const auto column = gradient_at(rows, q, f.data());
      for (int i = 0; i < 2; ++i) {
        EXPECT_NEAR(value[i], expected[i], 1e-13);
        for (int K = 0; K < 2; ++K) EXPECT_NEAR(at(column, K)[i], H(i, K), 1e-11);
      }
    }
    // Nothing across the axis moves a particle that is on it.
    for (Index A = 0; A < body.size(); ++A) {
      const Real across = value_at(body.at_particles, A, f.data())[0];
      EXPECT_TRUE(!body.on_axis(A) || across == 0) << across;
    }
  }
}

template <class Rule>
void expect_gradients(const Rule& rule, const NodalVectors& f, auto&& place) {
  for (Index g = 0; g < rule.groups(); ++g) {
    Tensor<Lanes> H;
    rule.gather(g, f.data(), H);
    for (int lane = 0; lane < rule.points_per_group(); ++lane) {
      if (!(rule.weight(g)[lane] > 0)) continue;
      const Mat<3> expected = gradient(place(g, lane));
      for (int i = 0; i < 3; ++i)
        for (int K = 0; K < 3; ++K) EXPECT_NEAR(H(i, K)[lane], expected(i, K), 2e-12);
    }
  }
}

TEST(Axisymmetry, CellsHaveExactGradientsOfQuadratics) {
  for (const std::string& shape : {ball, cylinder}) {
    const Scene<2> scene = test::scene_of<2>(heading() + solid(shape));
    const Body<2>& body = scene.system.bodies.front();
    const CellRule<2> rule = build_cell_rule(body).rule;
    expect_gradients(rule, test::field_on<2>(body, quadratic), [&](Index cell, int lane) {
      const Lanes* xi = rule.point.data() + cell * 2;
      return Vec<2>(body.cells.centroid(cell) + Vec<2>(xi[0][lane], xi[1][lane]));
    });
  }
}

TEST(Axisymmetry, GaussPointsHaveExactGradientsOfQuadratics) {
  const Scene<2> scene = test::scene_of<2>(heading() + solid(ball));
  const Body<2>& body = scene.system.bodies.front();
  const PointRule<2> rule = build_gauss_rule(body, 3);
  const auto points = cell_gauss_points(body.geometry.grid, 3);
  expect_gradients(rule, test::field_on<2>(body, quadratic),
                   [&](Index g, int lane) { return at(points.X, g * 4 + lane); });
}

/// A rule scatters by the transpose of what it gathers.
TEST(Axisymmetry, ScatteringIsTheTransposeOfGathering) {
  const Scene<2> scene = test::scene_of<2>(heading() + solid(ball));
  const Body<2>& body = scene.system.bodies.front();
  const NodalVectors u = test::random_field<2>(body.size(), 1, 3);
  const auto expect_transpose = [&](const auto& rule) {
    const Tensor<Lanes> P =
        Tensor<Lanes>::map([](int i, int K) { return Lanes(1.0 + i, 0.3 * K, 0.1 - i, 0.2); });
    Real gathered = 0;
    NodalVectors f(u.size(), Lanes::zero());
    for (Index g = 0; g < rule.groups(); ++g) {
      Tensor<Lanes> H;
      rule.gather(g, u.data(), H);
      gathered += sum(rule.weight(g) * contract(P, H));
      rule.scatter(g, rule.weight(g) * P, f.data());
    }
    EXPECT_NEAR(test::dot(f, u), gathered, 1e-11 * std::abs(gathered));
  };
  expect_transpose(build_cell_rule(body).rule);
  expect_transpose(build_gauss_rule(body, 2));
}

/// An even pressure inside is held by one outside: forces of stress and of the surface cancel.
TEST(Axisymmetry, EvenPressureIsInEquilibrium) {
  const std::string on = "[[traction]]\nbody = \"body\"\nname = ";
  Scene<2> scene = test::scene_of<2>(heading() + solid(cylinder) + on +
                                     "\"out\"\nwhere = \"x > 0.99\"\nforce = [0.7, 0]\n" + on +
                                     "\"up\"\nwhere = \"y > 1.29\"\nforce = [0, 0.7]\n" + on +
                                     "\"down\"\nwhere = \"y < -0.69\"\nforce = [0, -0.7]\n");
  const Body<2>& body = scene.system.bodies.front();
  const CellRule<2> rule = build_cell_rule(body).rule;
  NodalVectors f(static_cast<std::size_t>(body.size()), Lanes::zero());
  const NodalVectors still = f;
  for (Index g = 0; g < rule.groups(); ++g)
    rule.scatter(g, -0.7 * rule.weight(g) * Tensor<Lanes>::identity(), f.data());
  const Real size = test::norm(f);
  for (auto& term : scene.system.terms)
    if (term->name().starts_with("traction"))
      scene.system.add_force(*term, {0, still, still, {}}, f);
  EXPECT_GT(size, 1);
  EXPECT_LT(test::norm(f), 2e-13 * size);
}

TEST(Axisymmetry, VolumesAndMassesAreThoseOfSpace) {
  const Scene<2> scene = test::scene_of<2>(heading() + solid(ball));
  const Body<2>& body = scene.system.bodies.front();
  EXPECT_NEAR(body.volume(), 4 * pi / 3, 1e-4);  // the surface is quadratic between the nodes
  EXPECT_NEAR(body.volume(), volume(body.geometry.grid), 1e-13);
  Real mass = 0, across = 0, along = 0, least = 1e300;
  for (Index A = 0; A < body.size(); ++A) {
    const Vec<2>& X = at(body.particles.X(), A);
    const Real m = at(body.mass, A);
    mass += m;
    across += m * X[0] * X[0];
    along += m * X[1] * X[1];
    least = std::min(least, m / (2 * body.cells.volume(A)));
  }
  EXPECT_NEAR(mass, 2 * body.volume(), 1e-12);
  EXPECT_NEAR(across, 2 * 8 * pi / 15, 1e-3);
  EXPECT_NEAR(along, across / 2, 1e-3);
  EXPECT_GE(least, 0.3 - 1e-12);
}

/// Half a disk and a disk of which the other half is left out are the same.
/// In a shell with a small cavity, the opposite wall may lie beyond the axis.
TEST(Axisymmetry, KernelsDoNotReachAcrossACavity) {
  const std::string shell =
      solid("shape = \"sphere_shell\"\nradius = 1\nthickness = 0.8\nspacing = 0.25\n");
  const Scene<2> half = test::scene_of<2>(heading() + shell),
                 whole = test::scene_of<2>("dimension = 2\n[time]\nend = 1\n" + shell);
  const auto &of_half = half.system.bodies.front().particles,
             &of_whole = whole.system.bodies.front().particles;
  Real least = 1, most = 0;
  for (Index A = 0; A < of_half.size(); ++A) {
    Index same = 0;
    for (Index B = 1; B < of_whole.size(); ++B)
      if ((at(of_whole.X(), B) - at(of_half.X(), A)).norm() <
          (at(of_whole.X(), same) - at(of_half.X(), A)).norm())
        same = B;
    EXPECT_NEAR(at(of_half.support(), A), at(of_whole.support(), same), 1e-12);
    least = std::min(least, at(of_half.support(), A));
    most = std::max(most, at(of_half.support(), A));
  }
  EXPECT_LT(least, 0.7 * most);  // some are shortened
}

TEST(Axisymmetry, ShellsHaveTheMeasuresOfCells) {
  Scene<2> scene =
      test::scene_of<2>(heading() +
                        solid("shape = \"disk_shell\"\nradius = 5\nheight = 3\nthickness = 0.5\n"
                              "spacing = 0.25\n") +
                        "[[profile]]\nbody = \"body\"\nr = [0, 1, 2]\nz = [1.6, 1.6, 1.6]\n");
  const NodalVectors rest(static_cast<std::size_t>(scene.system.size()), Lanes::zero());
  const std::map<std::string, std::pair<Real, Real>> expected{
      {"diameter", {10, 1e-4}},           {"pole_thickness", {3, 1e-9}},
      {"asymmetry", {0, 1e-9}},           {"largest_thickness", {3, 1e-9}},
      {"profile_rms", {0.1, 1e-9}},       {"outer_area", {208.87419, 0.02}},
      {"outer_volume", {207.31380, 0.04}}};
  std::size_t found = 0;
  for (const MeasureSource& m : scene.measures)
    if (const auto e = expected.find(m.name.substr(m.name.find('.') + 1)); e != expected.end()) {
      ++found;
      EXPECT_NEAR(m.compute({0, rest, rest}), e->second.first, e->second.second) << m.name;
    }
  EXPECT_EQ(found, expected.size());
}

TEST(Axisymmetry, WhatIsBeyondTheAxisIsLeftOut) {
  const Geometry<2> whole = test::disk(6, 3), half = half_plane(whole);
  EXPECT_EQ(half.grid.cell_count() * 2, whole.grid.cell_count());
  EXPECT_EQ(half.grid.facets.size() * 2, whole.grid.facets.size());
  for (const Vec<2>& X : half.grid.X) EXPECT_GE(X[0], 0);
}

void expect_refused(const std::string& scene, const std::string& message) {
  EXPECT_THROW_WITH(test::scene_of<2>(scene), InputError, message);
}

TEST(Axisymmetry, WhatIsNotOfRevolutionIsRefused) {
  const std::string body = heading() + solid(ball);
  expect_refused(heading() + solid("shape = \"disk\"\nradius = 1\ncore = 5\nrings = 3\n"),
                 "body[0].shape: has a cell across the axis x = 0");
  expect_refused(heading() + solid("shape = \"disk\"\nradius = 1\ncentre = [-3, 0]\n"),
                 "lies at x < 0; allowed is x >= 0, the distance from the axis");
  expect_refused(body + "[[body_force]]\nbody = \"body\"\nacceleration = [1, 0]\n",
                 "body_force[0].acceleration: acts across the axis of revolution");
  expect_refused(body + "[[spring]]\nbody = \"body\"\nat = [-0.1, 0.5]\nconstant = 3\n",
                 "spring[0].at: has x = -0.1, beyond the axis; allowed is >= 0");
  const std::string contact = body +
                              "[[contact]]\nbodies = [\"body\"]\nadhesion = 0.1\noffset = 0.2\n"
                              "range = 0.3\n[contact.partner]\n";
  expect_refused(contact + "type = \"half_space\"\npoint = [0, -1.3]\nnormal = [0.1, 1]\n",
                 "contact[0].partner: is not of revolution about the axis x = 0");
  expect_refused(contact + "type = \"ball\"\ncentre = [0.1, -2]\nradius = 0.8\n",
                 "contact[0].partner: is not of revolution about the axis x = 0");
  const std::string below = contact + "type = \"ball\"\ncentre = [0, -2]\nradius = 0.8\n";
  expect_refused(below + "displacement = [\"t\", 0]\n",
                 "is displaced across the axis of revolution; allowed is 0 for x in displacement");
  expect_refused(below + "direction = [0.6, 0.8]\nforce = 1\nstiffness = 1\n",
                 "is pressed across the axis of revolution; allowed is 0 for x in direction");
  expect_refused("dimension = \"axisymetric\"\n[time]\nend = 1\n" + solid(ball),
                 "dimension: 'axisymetric' is unknown; allowed is axisymmetric");
  expect_refused(body + "[[held]]\nbody = \"body\"\nwhere = \"y > 0\"\nangle = 0.1\n",
                 "held[0].angle: turns the face out of a body of revolution");
  expect_refused(heading() + solid("shape = \"disk\"\nradius = 1\ncentre = [1.2, 0]\n"
                                   "initial_displacement = [-0.5, 0]\n"),
                 "is beyond the axis x = 0: the body pinches off or closes over its axis");
}

}  // namespace
}  // namespace meniscus::test_axisymmetry
