// SPDX-License-Identifier: BSD-3-Clause
// Held faces: patch tests, exact stresses, exact motion, stable step, work, and refused scenes.
#include "cases.hpp"
#include "meniscus/error.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "run/simulation.hpp"
#include "solve/step/central_difference.hpp"
#include "support.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meniscus::test_held {
namespace {

const std::string neo_hookean = "type = \"neo_hookean\", density = 1, mu = 1, lambda = 1.5";

std::string block(int D, const std::string& body = "", const std::string& material = neo_hookean,
                  const std::string& time = "end = 100") {
  return "dimension = " + std::to_string(D) + "\n[time]\n" + time +
         "\n[[body]]\nname = \"block\"\nshape = \"" +
         (D == 3 ? "box\"\nsize = [1, 1, 1]\ncells = [6, 6, 6]\n"
                 : "rectangle\"\nsize = [1, 1]\ncells = [8, 8]\n") +
         "jitter = 0.3\n" + body + "material = { " + material + " }\n";
}

std::string held(const std::string& face, const std::string& more = "") {
  return "[[held]]\nbody = \"block\"\n" + (face.empty() ? "where = 1" : "face = \"" + face + "\"") +
         "\n" + more;
}

Real largest(const NodalVectors& field) {
  Real most = 0;
  for (const Lanes& x : field) most = std::max(most, std::sqrt(sum(x * x)));
  return most;
}

template <int D>
Real measured(const Scene<D>& scene, const State& state, const std::string& name) {
  for (const MeasureSource& measure : scene.measures)
    if (measure.name == name) return measure.compute(state.motion());
  ADD_FAILURE() << "no measure " << name;
  return 0;
}

/// The scene starts at rest: the forces vanish, and 40 steps do not move it.
template <int D>
void expect_rest(Scene<D>& scene, Simulation<D>& simulation, Real within) {
  simulation.begin();
  const NodalVectors begin = scene.initial.u;
  EXPECT_LT(largest(test::sum_of(simulation.state().u, -1, begin)), within);
  EXPECT_LT(largest(simulation.state().force), within);
  for (int step = 0; step < 40; ++step) simulation.advance();
  EXPECT_LT(largest(test::sum_of(simulation.state().u, -1, begin)), within);
}

template <int D>
void expect_linear_field_at_rest(const std::string& field, Real within) {
  Scene<D> scene = test::scene_of<D>(block(D, "initial_displacement = " + field) +
                                     held("", "displacement = " + field));
  Simulation<D> simulation(scene);
  expect_rest(scene, simulation, within);
}

TEST(Held, LinearFieldsAreAtRestWithAllFacesHeld) {
  expect_linear_field_at_rest<2>("[\"0.1*x + 0.2*y + 0.3\", \"-0.15*x + 0.05*y - 0.1\"]\n", 1e-12);
  // S has a condition number of 1e8 because of edges and corners.
  expect_linear_field_at_rest<3>(
      "[\"0.1*x + 0.2*y - 0.1*z\", \"-0.15*x + 0.05*y + 0.1*z\", \"0.05*x + 0.1*y - 0.1*z\"]\n",
      1e-11);
}

/// Stretches of a bar across its axis, and its stress, if it is pulled to the stretch 1.3.
struct Tension {
  Real across, stress;
};
Tension tension(const std::string& material, int D) {
  const auto input = SceneInput::from_text("material = { " + material + " }\n");
  const auto table = input.root().table("material");
  const auto law = laws().at(*table->kind("type", laws().names())).read(*table);
  const auto P = [&](Real across) {
    Tensor<Real> H = Tensor<Real>::zero();
    H(0, 0) = 0.3;
    H(1, 1) = across - 1;
    if (D == 3) H(2, 2) = across - 1;
    return law->stress(H);
  };
  Real low = 0.7, high = 1;
  for (int k = 0; k < 100; ++k) {
    const Real middle = (low + high) / 2;
    (P(middle)(1, 1) < 0 ? low : high) = middle;
  }
  return {low, P(low)(0, 0)};
}

/// A body that is clamped at both ends in the deformation of uniaxial tension.
template <int D>
void expect_tension(const std::string& material, const std::string& integration = "") {
  SCOPED_TRACE(material);
  const Tension exact = tension(material, D);
  std::string field = fmt::format("[\"0.3*x\", \"{0:.17g}*y\"", exact.across - 1);
  field += D == 3 ? fmt::format(", \"{0:.17g}*z\"]\n", exact.across - 1) : "]\n";
  Scene<D> scene =
      test::scene_of<D>(block(D, integration + "initial_displacement = " + field, material) +
                        held("x_min", "displacement = " + field) +
                        held("x_max", "name = \"grip\"\ndisplacement = " + field));
  Simulation<D> simulation(scene);
  expect_rest(scene, simulation, 1e-12);
  const State& state = simulation.state();
  EXPECT_GT(exact.stress, 0.1);
  EXPECT_NEAR(measured(scene, state, "grip.force_x"), exact.stress, 1e-10);
  EXPECT_NEAR(measured(scene, state, "block-x_min.force_x"), -exact.stress, 1e-10);
  EXPECT_NEAR(measured(scene, state, "grip.force_y"), 0, 1e-10);
  EXPECT_NEAR(measured(scene, state, "grip.torque_z"), 0, 1e-10);
}

TEST(Held, TensionHasTheStressOfEachLaw) {
  expect_tension<2>(neo_hookean);
  expect_tension<3>(neo_hookean);
  expect_tension<3>("type = \"mooney_rivlin\", density = 1, c1 = 0.4, c2 = 0.1, lambda = 1.5");
  expect_tension<3>("type = \"st_venant_kirchhoff\", density = 1, mu = 1, lambda = 1.5");
  expect_tension<3>(
      "type = \"liquid_crystal_elastomer\", density = 1, mu = 1, bulk_modulus = 2, step_length = "
      "2, reference_director = [1, 0, 0]");
}

/// Constraints can only lower the largest frequency (interlacing of eigenvalues).
TEST(Held, StableStepIsNeverShorter) {
  const auto stable = [](const std::string& more) {
    Scene<2> scene = test::scene_of<2>(block(2) + more);
    Simulation<2> simulation(scene);
    simulation.begin();
    return simulation.controller().stable().dt;
  };
  const Real free = stable(""), one = stable(held("x_min")),
             two = stable(held("x_min") + held("x_max")), all = stable(held(""));
  EXPECT_GE(one, free * (1 - 1e-3));
  EXPECT_GE(two, one * (1 - 1e-3));
  EXPECT_GT(all, 1.2 * free);
}

/// Errors in a smooth motion of a grip: the largest C u - g of any step, and the balance of energy
/// at the end.
struct Errors {
  Real place = 0, balance = 0;
};
Errors moved_by_a_grip(Real safety) {
  const std::string way = "(t/10 - sin(pi*t/5)/(2*pi))";
  Scene<2> scene = test::scene_of<2>(
      block(2, "", neo_hookean, fmt::format("end = 10\nsafety = {}", safety)) + held("x_min") +
      held("x_max", fmt::format("name = \"grip\"\ndisplacement = [\"0.2*{0}\", \"0.1*x*{0}\"]\n"
                                "angle = \"0.3*{0}\"\ncentre = [0.5, 0]\n",
                                way)));
  Simulation<2> simulation(scene);
  simulation.begin();
  const Constraints& held_places = *scene.system.constraints;
  std::vector<Real> g(static_cast<std::size_t>(held_places.rows())), Cu = g;
  Errors errors;
  while (!simulation.finished()) {
    simulation.advance();
    simulation.audit_now();
    held_places.targets(simulation.state().time, g);
    held_places.apply(simulation.state().u, Cu);
    for (std::size_t r = 0; r < g.size(); ++r)
      errors.place = std::max(errors.place, std::abs(g[r] - Cu[r]));
  }
  const State& state = simulation.state();
  errors.balance = std::abs(simulation.audit().balance_error(simulation.audit_now()));
  EXPECT_GT(measured(scene, state, "grip.work"), 1e-2);
  EXPECT_NEAR(measured(scene, state, "grip.work"), state.books.external_work, 1e-15);
  return errors;
}

TEST(Held, GripsGoWhereTheyAreToldAndTheirWorkIsBooked) {
  const Errors coarse = moved_by_a_grip(0.8), fine = moved_by_a_grip(0.2);
  EXPECT_LT(coarse.place, 1e-15);
  EXPECT_LT(fine.place, 1e-15);
  EXPECT_LT(fine.balance, 1e-6);
  EXPECT_LT(fine.balance, 0.1 * coarse.balance);  // of second order
}

TEST(Held, WhatCannotBeHeldIsRefused) {
  const auto message = [](const std::string& more) -> std::string {
    try {
      test::scene_of<2>(block(2) + more);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const auto expect = [&](const std::string& more, const std::string& part) {
    EXPECT_NE(message(more).find(part), std::string::npos) << message(more);
  };
  expect(held("x_min") + held("x_min", "name = \"again\"\ncomponents = [\"y\"]\n"),
         "held face 'again' asks for more than the particles can follow: at (-0.5, ");
  expect(held("left"), "body 'block' has no face 'left'; allowed are x_min, x_max, y_min, y_max");
  expect(held("x_min", "where = \"x > 0\"\n"), "no facet of the surface of body 'block' is chosen");
  expect(held("x_min", "components = [\"z\"]\n"), "'z' is no component; allowed are x, y, normal");
}

}  // namespace
}  // namespace meniscus::test_held
