// SPDX-License-Identifier: BSD-3-Clause
// Bending of surfaces: energies against closed forms and quadrature, forces as the exact gradient,
// the bound of Willmore after a relaxation, pressure by bending, refusals (membranes notes 2 and
// 3).
#include "meniscus/error.hpp"
#include "meniscus/physics/surface_registry.hpp"
#include "surface_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus::test_bending {
namespace {

using std::numbers::pi;
using test::law_of;

template <int D>
std::unique_ptr<ForceTerm> bending_of(const Body<D>& body, const std::string& numbers = "") {
  return test::surface_term(body, "helfrich", "bending_modulus = 1\n" + numbers, D == 3 ? 12 : 16);
}

template <int D>
void expect_gradients() {
  const auto body = test::body_of<D>(test::potato<D>());
  for (const std::string numbers :
       {"", "spontaneous_curvature = 0.7\n", "natural = \"reference\"\n"}) {
    SCOPED_TRACE(numbers);
    const auto term = bending_of(*body, numbers);
    test::expect_balanced_gradient<D>(*term, *body, 0.01, 1e-4, 1e-12);
  }
}

TEST(Bending, ForcesAreTheGradientOfTheEnergyAndBalanced) {
  expect_gradients<2>();
  expect_gradients<3>();
}

/// The part of a surface of revolution z(r) (both sides) of the integral of (2H)^2/2, with the
/// parameter t of r(t), z(t) from pole to equator, by central differences of the curve.
template <class Curve>
Real energy_of_revolution(Curve&& curve) {
  constexpr int n = 20000;
  constexpr Real h = 1e-4;
  Real sum = 0;
  for (int k = 0; k < n; ++k) {
    const Real t = (k + 0.5) * (pi / 2) / n;
    const auto [r, z] = curve(t);
    const auto [r_after, z_after] = curve(t + h);
    const auto [r_before, z_before] = curve(t - h);
    const Real r1 = (r_after - r_before) / (2 * h), z1 = (z_after - z_before) / (2 * h),
               r2 = (r_after - 2 * r + r_before) / (h * h),
               z2 = (z_after - 2 * z + z_before) / (h * h), s = std::hypot(r1, z1);
    const Real along = (z1 * r2 - r1 * z2) / (s * s * s), across = -z1 / (r * s);
    sum += (along + across) * (along + across) / 2 * 2 * pi * r * s * (pi / 2) / n;
  }
  return 2 * sum;
}
/// An ellipsoid of revolution with the semi-axes 1, 1, c.
Real energy_of_ellipsoid(Real c) {
  return energy_of_revolution([c](Real t) { return std::pair(std::sin(t), c * std::cos(t)); });
}
/// Half of the thickness of the red blood cell of Evans and Fung 1972 over that of a ball.
Real biconcave(Real r2) {
  return (0.81 + 7.83 * r2 - 4.39 * r2 * r2) / 3.91 / 2;
}

TEST(Bending, ReferenceOfTheQuadrature) {
  EXPECT_NEAR(energy_of_ellipsoid(1), 8 * pi, 1e-6);
  EXPECT_NEAR(energy_of_ellipsoid(1.5), 27.15748310849398, 1e-6);
}

/// A sphere has 8 pi kappa at any size. Its images by linear maps, which the shape functions
/// reproduce, have errors of the quadrature alone.
TEST(Bending, SpheresAndEllipsoidsHaveTheirEnergy) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const auto term = bending_of(*body);
  const auto energy = [&](const Vec<3>& axes) {
    return test::energy_of(*term, test::field_on<3>(*body, [&](const Vec<3>& X) {
      return Vec<3>((axes.array() * X.array()).matrix() - X);
    }));
  };
  EXPECT_NEAR(energy({1, 1, 1}), 8 * pi, 1e-11);
  EXPECT_NEAR(energy({0.3, 0.3, 0.3}), 8 * pi, 1e-11);
  for (const Real c : {0.5, 0.8, 1.5, 2.0})
    EXPECT_NEAR(energy({1, 1, c}), energy_of_ellipsoid(c), 1e-5) << c;
}

/// The body and the bending of a disk in the half plane, a ball of radius 1.
Scene<2> ball_in_half_plane(int core, int rings, const std::string& numbers = "") {
  return test::scene_of<2>(
      "dimension = \"axisymmetric\"\n[time]\nend = 1\n" + test::ball_of(2, core, rings) +
      "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1 }\n" +
      law_of("helfrich", "bending_modulus = 1\n" + numbers));
}

TEST(Bending, TheHalfPlaneHasTheEnergyOfTheBody) {
  const Scene<2> scene = ball_in_half_plane(6, 3);
  const Body<2>& body = scene.system.bodies.front();
  const auto energy = [&](Real across, Real along) {
    return test::energy_of(*scene.system.terms.back(),
                           test::field_on<2>(body, [&](const Vec<2>& X) {
                             return Vec<2>((across - 1) * X[0], (along - 1) * X[1]);
                           }));
  };
  EXPECT_NEAR(energy(1, 1), 8 * pi, 1e-9);
  EXPECT_NEAR(energy(0.3, 0.3), 8 * pi, 1e-9);
  for (const Real c : {0.5, 0.8, 1.5, 2.0})
    EXPECT_NEAR(energy(1, c), energy_of_ellipsoid(c), 1e-5) << c;
}

/// The red blood cell of Evans and Fung, whose shape the shape functions approximate only.
TEST(Bending, ABiconcaveDiscHasItsEnergyUnderRefinement) {
  const Real exact = energy_of_revolution([](Real t) {
    const Real r = std::sin(t);
    return std::pair(r, std::cos(t) * biconcave(r * r));
  });
  EXPECT_NEAR(exact, 48.47445909, 1e-5);
  const auto error = [&](int core, int rings) {
    const Scene<2> scene = ball_in_half_plane(core, rings);
    const NodalVectors u = test::field_on<2>(scene.system.bodies.front(), [&](const Vec<2>& X) {
      return Vec<2>(0, X[1] * (biconcave(X[0] * X[0]) - 1));
    });
    return std::abs(test::energy_of(*scene.system.terms.back(), u) / exact - 1);
  };
  const Real coarse = error(6, 3), fine = error(24, 12);
  EXPECT_LT(fine, 0.002);
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.5) << coarse << " " << fine;
}

/// A circle has pi kappa/R per depth; the natural shape of the reference has no moment.
TEST(Bending, SpontaneousCurvatures) {
  const auto disk = test::body_of<2>(test::disk(6, 3));
  const NodalVectors still(static_cast<std::size_t>(disk->size()), Lanes::zero());
  EXPECT_NEAR(test::energy_of(*bending_of(*disk), still), pi, 1e-10);
  EXPECT_NEAR(test::energy_of(*bending_of(*disk, "spontaneous_curvature = 3\n"), still), 4 * pi,
              1e-9);
  const auto potato = test::body_of<3>(test::potato<3>());
  const auto natural = bending_of(*potato, "natural = \"reference\"\n");
  const NodalVectors rest(static_cast<std::size_t>(potato->size()), Lanes::zero());
  EXPECT_NEAR(test::energy_of(*natural, rest), 0, 1e-20);
  EXPECT_LT(test::norm(test::force_of(*natural, rest)), 1e-9);
}

/// A sphere of radius v has the energy 8 pi kappa (1 - c0 v/2)^2, so that a liquid inside has the
/// pressure -2 kappa c0 (1 - c0 v/2)/v^2.
TEST(Bending, SpontaneousCurvaturePressesALiquid) {
  constexpr Real kappa = 0.5, c0 = -1;
  Scene<2> scene = test::scene_of<2>(
      "dimension = \"axisymmetric\"\n[time]\nsolver = \"newton\"\nend = 1e3\n" +
      test::ball_of(2, 6, 3) +
      "material = { type = \"newtonian\", density = 1, bulk_modulus = 50, viscosity = 1 }\n" +
      law_of("helfrich", "bending_modulus = 0.5\nspontaneous_curvature = -1\n"));
  Simulation<2> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  const auto measured = [&](const char* name) {
    return test::measured(scene, simulation.state(), name);
  };
  const Real v = measured("b.radius"), pressure = -2 * kappa * c0 * (1 - c0 * v / 2) / (v * v);
  EXPECT_NEAR(measured("b.mean_pressure"), pressure, 2e-3 * pressure);
  EXPECT_LT(v, 0.999);
}

/// The least bending energy of a closed surface is 8 pi kappa (Willmore). An ellipsoid that relaxes
/// comes to it, and does not fall below by more than the error of quadrature.
TEST(Bending, NoRelaxationFallsBelowTheSphere) {
  Scene<2> scene = test::scene_of<2>(
      "dimension = \"axisymmetric\"\n[time]\nsolver = \"newton\"\nend = 1e3\n[[body]]\nname = "
      "\"b\"\nshape = \"ellipse\"\nsemi_axes = [0.8, 1.4]\ncore = 6\nrings = 3\n"
      "material = { type = \"newtonian\", density = 1, bulk_modulus = 100, viscosity = 1 }\n" +
      law_of("helfrich", "bending_modulus = 1\n"));
  Simulation<2> simulation(scene);
  simulation.begin();
  const auto measured = [&](const char* name) {
    return test::measured(scene, simulation.state(), name);
  };
  EXPECT_NEAR(measured("b.helfrich.energy"), energy_of_ellipsoid(1.75), 1e-4);
  while (!simulation.finished()) {
    simulation.advance();
    EXPECT_GT(measured("b.helfrich.energy"), 8 * pi * (1 - 1e-3));
  }
  EXPECT_LT(measured("b.helfrich.energy"), 8 * pi * (1 + 1e-3));
  EXPECT_NEAR(measured("b.aspect"), 1, 5e-3);
}

std::string cylinder(const std::string& lines) {
  return "dimension = 3\n[time]\nend = 1\n[[body]]\nname = \"b\"\nshape = \"cylinder\"\nradius = "
         "0.5\nheight = 2\ncore = 4\nrings = 2\nlayers = 6\nmaterial = { type = \"neo_hookean\", "
         "density = 1, mu = 1, lambda = 1 }\n" +
         lines;
}
std::string on_face(const std::string& face, const std::string& type, const std::string& numbers) {
  return "[[surface]]\nbody = \"b\"\nface = \"" + face + "\"\n[surface.law]\ntype = \"" + type +
         "\"\n" + numbers;
}

/// The side of a cylinder of height h has the energy pi kappa h/R. The energy of a membrane on it
/// depends on the area of the side alone. The reference has this area up to the error of three
/// points per direction.
TEST(Bending, LawsActOnFacesAlone) {
  const Scene<3> scene =
      test::scene_of<3>(cylinder(on_face("side", "helfrich", "bending_modulus = 1\n") +
                                 on_face("side", "skalak", "shear_modulus = 1\n") +
                                 on_face("z_max", "skalak", "shear_modulus = 1\n")));
  const NodalVectors u = test::field_on<3>(scene.system.bodies.front(), [](const Vec<3>& X) {
    return Vec<3>(0.2 * X[0], 0.2 * X[1], 0.5 * X[2]);
  });
  const auto measured = [&](const char* name) {
    for (const MeasureSource& measure : scene.measures)
      if (measure.name == name) return measure.compute({0, u, u});
    return 0.0;
  };
  EXPECT_NEAR(measured("b.helfrich.side.energy"), pi * 3 / 0.6, 1e-9);
  EXPECT_NEAR(measured("b.skalak.side.area"), 2 * pi * 0.6 * 3, 5e-5);
  EXPECT_NEAR(measured("b.skalak.z_max.area"), pi * 0.36, 5e-6);
  const auto published = [](Real a, Real b) {
    const Real I1 = a * a + b * b - 2, I2 = a * a * b * b - 1;
    return (I1 * I1 + 2 * I1 - 2 * I2 + I2 * I2) / 4;
  };
  const auto term = [&](const std::string& name) -> ForceTerm& {
    return **std::find_if(scene.system.terms.begin(), scene.system.terms.end(),
                          [&](const auto& t) { return t->name() == name; });
  };
  EXPECT_NEAR(test::energy_of(term("skalak of the face 'side' of 'b'"), u),
              2 * pi * published(1.2, 1.5), 5e-5);
  EXPECT_NEAR(test::energy_of(term("skalak of the face 'z_max' of 'b'"), u),
              pi / 4 * published(1.2, 1.2), 5e-6);
  ForceTerm& bending = term("bending of the face 'side' of 'b'");
  const NodalVectors noisy =
      test::sum_of(u, 1, test::random_field<3>(scene.system.bodies.front().size(), 0.01, 3));
  EXPECT_LT(
      test::gradient_error(bending, noisy,
                           test::random_field<3>(scene.system.bodies.front().size(), 1, 8), 1e-4),
      1e-8);
}

std::string refusal(const std::string& text) {
  try {
    Scene<3> scene = test::scene_of<3>(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Bending, NeedsASmoothSurfaceAndEnoughPoints) {
  const std::string
      heading = "dimension = 3\n[time]\nend = 1\n",
      solid = "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1 }\n",
      box = "[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [1, 1, 1]\ncells = [3, 3, 3]\n",
      law = law_of("helfrich", "bending_modulus = 1\n");
  EXPECT_EQ(refusal(heading + test::ball_of(3, 2, 2) + solid + law), "");
  const std::string edges = refusal(heading + box + solid + law);
  EXPECT_NE(edges.find("bending needs a smooth surface"), std::string::npos) << edges;
  const std::string liquid =
      "material = { type = \"newtonian\", density = 1, bulk_modulus = 9, viscosity = 1 }\n";
  const auto with_points = [&](const std::string& material, int points) {
    return refusal(heading + test::ball_of(3, 2, 2) + material +
                   fmt::format("[[surface]]\nbody = \"b\"\npoints = {}\n[surface.law]\ntype = "
                               "\"helfrich\"\nbending_modulus = 1\n",
                               points));
  };
  EXPECT_EQ(with_points(liquid, 10), "");
  EXPECT_EQ(with_points(solid, 5), "");
  const std::string few = with_points(liquid, 9);
  EXPECT_NE(few.find("9 points per direction are too few for \"helfrich\""), std::string::npos)
      << few;
  EXPECT_NE(few.find("expected are at least 10"), std::string::npos) << few;
  EXPECT_NE(with_points(solid, 4).find("expected are at least 5"), std::string::npos);
  const std::string other = refusal(cylinder(on_face("sides", "skalak", "shear_modulus = 1\n"))),
                    tension = refusal(cylinder(on_face("side", "tension", "gamma = 1\n")));
  EXPECT_NE(other.find("sides"), std::string::npos) << other;
  EXPECT_NE(tension.find("goes with [[surface_tension]]"), std::string::npos) << tension;
}

}  // namespace
}  // namespace meniscus::test_bending
