// SPDX-License-Identifier: BSD-3-Clause
// Membrane laws on surfaces: energies of uniform stretches, inflation of a spherical capsule, and a
// capsule that is stretched along its axis, against exact solutions (membranes note 1).
#include "meniscus/physics/surface_registry.hpp"
#include "surface_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace meniscus::test_membranes {
namespace {

using test::law_of;

/// A law, and its energy per reference area at the principal stretches a, b as it is published.
struct Membrane {
  std::string type, numbers;
  std::function<Real(Real a, Real b)> energy;

  /// Derivative by the first stretch, the tension per reference length across it.
  Real slope(Real a, Real b) const {
    constexpr Real h = 1e-3;
    const auto difference = [&](Real d) { return (energy(a + d, b) - energy(a - d, b)) / (2 * d); };
    return (4 * difference(h / 2) - difference(h)) / 3;
  }
};

std::vector<Membrane> membranes() {
  const auto skalak = [](Real C) {
    return [C](Real a, Real b) {
      const Real I1 = a * a + b * b - 2, I2 = a * a * b * b - 1;
      return 0.3 / 4 * (I1 * I1 + 2 * I1 - 2 * I2 + C * I2 * I2);
    };
  };
  return {{"skalak", "shear_modulus = 0.3\n", skalak(1)},
          {"skalak", "shear_modulus = 0.3\nC = 20\n", skalak(20)},
          {"evans_skalak", "shear_modulus = 0.3\narea_modulus = 0.7\n", [](Real a, Real b) {
             return 0.3 / 2 * (a / b + b / a - 2) + 0.7 / 2 * (a * b - 1) * (a * b - 1);
           }}};
}

template <int D>
void expect_gradients() {
  for (const auto& body : {test::body_of<D>(test::potato<D>()),
                           test::body_of<D>(test::brick<D>(D == 3 ? std::vector<Real>{3, 3, 2}
                                                                  : std::vector<Real>{4, 3}))})
    for (const Membrane& membrane : membranes()) {
      SCOPED_TRACE(membrane.type);
      const auto term = test::surface_term(*body, membrane.type, membrane.numbers);
      test::expect_balanced_gradient<D>(*term, *body, 0.03, 2e-4, 1e-13);
    }
}

TEST(Membranes, ForcesAreTheGradientOfTheEnergyAndBalanced) {
  expect_gradients<2>();
  expect_gradients<3>();
}

/// A brick that is stretched along its edges and then rotated has the published energy on each pair
/// of faces, and in 2D with the stretch 1 along the depth.
TEST(Membranes, UniformStretchesHaveThePublishedEnergy) {
  const auto brick = test::body_of<3>(test::brick<3>({3, 3, 2}));
  const auto plate = test::body_of<2>(test::brick<2>({4, 3}));
  Mat<3> R;
  R << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
  for (const Membrane& membrane : membranes()) {
    SCOPED_TRACE(membrane.type);
    const auto term = test::surface_term(*brick, membrane.type, membrane.numbers),
               flat = test::surface_term(*plate, membrane.type, membrane.numbers);
    for (const auto& stretch : {std::array{1.3, 1.3, 1.3},
                                {1.5, 0.8, 1.1},
                                {1 + 1e-5, 1.0, 1.0},
                                {0.6, 0.7, 1.2},
                                {2.0, 1.0, 1.0}}) {
      const Real a = stretch[0], b = stretch[1], c = stretch[2];
      SCOPED_TRACE(a);
      Mat<3> F = Vec<3>(a, b, c).asDiagonal();
      const NodalVectors u =
          test::field_on<3>(*brick, [&](const Vec<3>& X) { return Vec<3>(R * F * X - X); });
      const auto w = membrane.energy;
      const Real exact = 2 * (9 * w(a, b) + 6 * w(b, c) + 6 * w(a, c));
      EXPECT_NEAR(test::energy_of(*term, u), exact, 1e-12 * exact + 1e-15);
      const NodalVectors in_plane = test::field_on<2>(*plate, [&](const Vec<2>& X) -> Vec<2> {
        return {(a - 1) * X[0], (b - 1) * X[1]};
      });
      const Real lines = 2 * (4 * w(a, 1) + 3 * w(b, 1));
      EXPECT_NEAR(test::energy_of(*flat, in_plane), lines, 1e-12 * lines + 1e-15);
    }
  }
}

/// Linear moduli: at a small strain e the uniaxial energy is (K + G)/2 e^2 and the biaxial energy 2
/// K e^2, with the area modulus K = G (1 + 2 C) of Skalak's law.
TEST(Membranes, SmallStrainsHaveTheNamedModuli) {
  const auto brick = test::body_of<3>(test::brick<3>({2, 2, 2}));
  constexpr Real e = 1e-6;
  for (const auto& [type, numbers, G, K] :
       {std::tuple("skalak", "shear_modulus = 0.3\nC = 1\n", 0.3, 0.9),
        {"evans_skalak", "shear_modulus = 0.3\narea_modulus = 0.7\n", 0.3, 0.7}}) {
    const auto term = test::surface_term(*brick, type, numbers);
    const auto energy = [&](Real a, Real b) {
      return test::energy_of(*term, test::field_on<3>(*brick, [&](const Vec<3>& X) -> Vec<3> {
        return {a * X[0], b * X[1], 0};
      }));
    };
    // Of the six faces of 4, two are stretched both ways, two along x alone and two along y alone.
    const Real along = 8 * (K + G) / 2 * e * e;
    EXPECT_NEAR(energy(e, 0), 2 * along, 1e-4 * along);
    EXPECT_NEAR(energy(e, e), 2 * along + 8 * 2 * K * e * e, 1e-4 * along);
  }
}

/// The area cannot vanish: from an area ratio of 0.2 down, energies grow without bound.
TEST(Membranes, ABarrierKeepsTheArea) {
  const auto brick = test::body_of<3>(test::brick<3>({2, 2, 2}));
  for (const Membrane& membrane : membranes()) {
    const auto term = test::surface_term(*brick, membrane.type, membrane.numbers);
    const auto energy = [&](Real stretch) {
      return test::energy_of(*term, test::field_on<3>(*brick, [&](const Vec<3>& X) {
        return Vec<3>((stretch - 1) * X);
      }));
    };
    const auto published = [&](Real stretch) { return 24 * membrane.energy(stretch, stretch); };
    EXPECT_NEAR(energy(0.45), published(0.45), 1e-12 * published(0.45));
    EXPECT_GT(energy(0.2), published(0.2) + 24 * 0.3 * 60);
    EXPECT_GT(energy(0.02), 24 * 0.3 * 1e8);
  }
}

/// The stretch v of a ball of a soft solid inside a membrane, in equilibrium with a pressure p that
/// pulls at its surface: the root of the derivative of its energy.
Real inflated(const Membrane& membrane, Real p) {
  constexpr Real mu = 0.3, lambda = 0.5;
  const auto power = [&](Real v) {
    const Real bulk = mu * 3 * (v - 1 / v) + lambda * (v * v * v - 1) * 3 * v * v;
    return bulk / 3 + 2 * membrane.slope(v, v) - p * v * v;
  };
  Real low = 1, high = 2;
  while (high - low > 1e-13) (power((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return low;
}

template <int D>
Real inflated(const Membrane& membrane, Real p, int core, int layers) {
  Scene<D> scene = test::scene_of<D>(
      fmt::format(
          "dimension = {}\n[time]\nsolver = \"newton\"\nend = 1e3\nforce_tolerance = 1e-8\n",
          D == 3 ? "3" : "\"axisymmetric\"") +
      test::ball_of(D, core, layers) +
      "material = { density = 1, type = \"neo_hookean\", mu = 0.3, lambda = 0.5 }\n" +
      law_of(membrane.type, membrane.numbers) +
      fmt::format("[[cavity]]\nbody = \"b\"\nsurface = \"outer\"\npressure = {:.17g}\n", p));
  Simulation<D> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  return test::measured(scene, simulation.state(), "b.radius");
}

/// The pressure at which a sphere of a membrane has the stretch v, 2 T/v with the tension T = w'/(2
/// v) of the energy w(v, v): the power of the forces of the membrane on a uniform dilation. Errors
/// are those of the area of the reference by quadrature.
TEST(Membranes, SpheresHaveThePressureOfTheirTension) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const NodalVectors X = test::field_on<3>(*body, [](const Vec<3>& place) { return place; });
  const std::string ball =
      test::ball_of(2, 6, 3) +
      "material = { density = 1, type = \"neo_hookean\", mu = 1, lambda = 1 }\n";
  for (const Membrane& membrane : membranes()) {
    SCOPED_TRACE(membrane.type + " " + membrane.numbers);
    const Scene<2> scene = test::scene_of<2>("dimension = \"axisymmetric\"\n[time]\nend = 1\n" +
                                             ball + law_of(membrane.type, membrane.numbers));
    const NodalVectors X_of_plane =
        test::field_on<2>(scene.system.bodies.front(), [](const Vec<2>& place) { return place; });
    const auto term = test::surface_term(*body, membrane.type, membrane.numbers);
    for (const Real v : {0.9, 1.02, 1.3, 2.0}) {
      const Real exact = 2 * membrane.slope(v, v) / (v * v);
      const auto pressure = [&](ForceTerm& of, const NodalVectors& place) {
        return -test::dot(test::force_of(of, test::sum_of(test::zeros(place), v - 1, place)),
                          place) /
               (4 * std::numbers::pi * v * v);
      };
      EXPECT_NEAR(pressure(*term, X), exact, 1e-4 * std::abs(exact)) << v;
      EXPECT_NEAR(pressure(*scene.system.terms.back(), X_of_plane), exact, 1e-6 * std::abs(exact))
          << v;
    }
  }
}

/// Under a pressure that stretches a ball inside a membrane by more than 20 %, found as an
/// equilibrium.
TEST(Membranes, ASphericalCapsuleInflates) {
  for (const Membrane& membrane : {membranes().front(), membranes().back()}) {
    SCOPED_TRACE(membrane.type);
    const Real exact = inflated(membrane, 2);
    EXPECT_GT(exact, 1.2);
    const Real coarse = std::abs(inflated<2>(membrane, 2, 6, 3) - exact),
               fine = std::abs(inflated<2>(membrane, 2, 12, 6) - exact);
    EXPECT_LT(coarse, 3e-4 * exact);
    EXPECT_LT(fine, coarse / 1.5);
  }
}

/// A capsule of a nearly incompressible liquid is stretched by a dead load f z/R per area of the
/// reference. Half of its length and its radius at the equator were computed by minimising the
/// energy of the meridian over 12 harmonics (tests/reference/stretched_capsule.py).
TEST(Membranes, ACapsuleIsStretchedAlongItsAxis) {
  struct Error {
    Real half_length, radius;
  };
  const auto error = [](Real f, int core, int rings, Real half_length, Real radius) {
    Scene<2> scene = test::scene_of<2>(
        "dimension = \"axisymmetric\"\n[time]\nsolver = \"relax\"\nend = 1e3\n" +
        test::ball_of(2, core, rings) +
        "material = { type = \"newtonian\", density = 1, bulk_modulus = 400, viscosity = 1 }\n" +
        law_of("skalak", "shear_modulus = 1\n") +
        fmt::format("[[traction]]\nbody = \"b\"\nwhere = 1\nforce = [0, \"{}*y\"]\n", f));
    Simulation<2> simulation(scene);
    simulation.begin();
    while (!simulation.finished()) simulation.advance();
    const auto measured = [&](const char* name) {
      return test::measured(scene, simulation.state(), name) / 2;
    };
    return Error{std::abs(measured("b.extent_y") / half_length - 1),
                 std::abs(measured("b.extent_x") / radius - 1)};
  };
  const Error small = error(0.05, 6, 3, 1.02696377, 0.98652895),
              coarse = error(0.5, 6, 3, 1.21199552, 0.90164464),
              fine = error(0.5, 10, 5, 1.21199552, 0.90164464);
  EXPECT_LT(small.half_length, 5e-4);
  EXPECT_LT(small.radius, 5e-4);
  EXPECT_LT(fine.half_length, std::min(1e-3, coarse.half_length / 1.7));
  EXPECT_LT(fine.radius, std::min(1e-3, coarse.radius / 1.5));
}

}  // namespace
}  // namespace meniscus::test_membranes
