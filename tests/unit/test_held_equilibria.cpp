// SPDX-License-Identifier: BSD-3-Clause
// Equilibria of held and loaded bodies by Newton's method against exact solutions: patch tests,
// thick walls under pressure at large strains.
#include "cases.hpp"
#include "run/simulation.hpp"
#include "solve/newton/quasi_statics.hpp"
#include "solve/step/central_difference.hpp"
#include "support.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

namespace meniscus::test_held_equilibria {
namespace {

std::string block(int D, const std::string& held) {
  return fmt::format(
             "dimension = {}\n[time]\nsolver = \"newton\"\nend = 1\n[[body]]\nname = "
             "\"block\"\nshape = {}"
             "jitter = 0.3\nmaterial = {{ type = \"neo_hookean\", density = 1, mu = 1, lambda = "
             "1.5 }}\n",
             D,
             D == 3 ? "\"box\"\nsize = [1, 1, 1]\ncells = [6, 6, 6]\n"
                    : "\"rectangle\"\nsize = [1, 1]\ncells = [8, 8]\n") +
         held;
}

/// Newton's method ends at 1e-9 of the released energy. Each new start from its end reduces the
/// rest by another factor of 1e-9, down to round-off.
template <int D>
NodalVectors rest(Scene<D>& scene) {
  State state = scene.initial;
  start(scene.system, state);
  for (int time = 0; time < 3; ++time) {
    QuasiStatics<D> newton(scene.system, {.end = 1});
    newton.begin(state);
    newton.settle(state);
  }
  return state.u;
}

template <int D>
Real distance_from_linear(const Scene<D>& scene, const NodalVectors& u, const Tensor<Real>& H) {
  Real error = 0;
  for (Index A = 0; A < scene.system.size(); ++A) {
    const Vec<D>& X = at(scene.system.bodies.front().particles.X(), A);
    for (int i = 0; i < D; ++i) {
      Real exact = 0;
      for (int k = 0; k < D; ++k) exact += H(i, k) * X[k];
      error = std::max(error, std::abs(at(u, A)[i] - exact));
    }
  }
  return error;
}

/// Starts from a body at rest and moves all held faces to a linear field, on a disordered cloud.
template <int D>
Real error_of_linear_field(const std::string& held, const Tensor<Real>& H) {
  Scene<D> scene = test::scene_of<D>(block(D, held));
  return distance_from_linear(scene, rest(scene), H);
}

TEST(HeldEquilibria, FindLinearFieldsExactlyOnJitteredClouds) {
  Tensor<Real> H = Tensor<Real>::zero();
  H(0, 0) = 0.1, H(0, 1) = 0.2, H(1, 0) = -0.15, H(1, 1) = 0.05;
  EXPECT_LT(error_of_linear_field<2>("[[held]]\nbody = \"block\"\nwhere = 1\ndisplacement = "
                                     "[\"0.1*x + 0.2*y\", \"-0.15*x + 0.05*y\"]\n",
                                     H),
            1e-12);
  H(0, 2) = -0.1, H(1, 2) = 0.1, H(2, 0) = 0.05, H(2, 1) = 0.1, H(2, 2) = -0.1;
  EXPECT_LT(error_of_linear_field<3>(
                "[[held]]\nbody = \"block\"\nwhere = 1\ndisplacement = [\"0.1*x + 0.2*y - 0.1*z\", "
                "\"-0.15*x + 0.05*y + 0.1*z\", \"0.05*x + 0.1*y - 0.1*z\"]\n",
                H),
            1e-11);  // S has a condition number of 1e8 (edges, corners)
}

/// Uniform stress in a graded octant: there are forces only on its planes, along their normals, for
/// all particles whose supports do not reach the round face.
TEST(HeldEquilibria, AGradedOctantOnRollersFeelsUniformStressOnItsPlanesOnly) {
  Scene<3> scene = test::scene_of<3>(
      "dimension = 3\n[time]\nend = 1\n[[body]]\nname = \"block\"\nshape = \"octant\"\nradius = "
      "1\ncore = 12\nlayers = 6\ngrading = 1.3\njitter = 0.2\ninitial_displacement = [\"0.1*x\", "
      "\"0.05*y\", \"-0.1*z\"]\nmaterial = {type = \"neo_hookean\", density = 1, mu = 1, lambda = "
      "1.5}\n");
  State state = scene.initial;
  start(scene.system, state);
  const auto& particles = scene.system.bodies.front().particles;
  Real largest = 0, error = 0;
  Index inside = 0;
  for (Index A = 0; A < scene.system.size(); ++A) {
    const Vec<3>& X = at(particles.X(), A);
    // Also excludes particles that share a cell with such a particle.
    if (X.norm() + 2 * at(particles.support(), A) > 1) continue;
    for (int i = 0; i < 3; ++i) {
      const Real f = std::abs(at(state.force, A)[i]);
      largest = std::max(largest, f);
      if (X[i] > 2 * at(particles.support(), A)) error = std::max(error, f), ++inside;
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(largest, 1e-4);
  EXPECT_LT(error, 1e-12 * largest);
}

/// Two opposite faces between rollers, the others free: uniaxial stress, P(1, 1) = 0.
template <int D>
void expect_uniaxial() {
  const Real a = 1.2, mu = 1, lambda = 1.5;
  Real low = 0.8, high = 1;
  for (int k = 0; k < 100; ++k) {
    const Real b = (low + high) / 2, side = D == 3 ? b : 1, J = a * b * side;
    (mu * (b - 1 / b) + lambda * (J - 1) * a * side < 0 ? low : high) = b;
  }
  Tensor<Real> H = Tensor<Real>::zero();
  H(0, 0) = a - 1;
  for (int i = 1; i < D; ++i) H(i, i) = low - 1;
  std::string held;
  for (int i = 0; i < D; ++i)
    held += fmt::format(
        "[[held]]\nbody = \"block\"\nface = \"{0}_min\"\ncomponents = [\"{0}\"]\n"
        "displacement = [{1}]\n",
        std::string(1, "xyz"[i]), [&] {
          std::string u;
          for (int k = 0; k < D; ++k)
            u += fmt::format("{}{:.17g}", k ? ", " : "", k == i ? -0.5 * H(i, i) : 0);
          return u;
        }());
  held += fmt::format(
      "[[held]]\nname = \"grip\"\nbody = \"block\"\nface = \"x_max\"\ncomponents = [\"x\"]\n"
      "displacement = [{}, 0{}]\n",
      0.5 * H(0, 0), D == 3 ? ", 0" : "");
  EXPECT_LT(error_of_linear_field<D>(held, H), 1e-12) << D;
}

TEST(HeldEquilibria, FindUniaxialStressExactlyBetweenTwoFaces) {
  expect_uniaxial<2>();
  expect_uniaxial<3>();
}

/// A thick wall between the radii 1/2 and 1 with the pressure p inside: current radii of both
/// faces.
struct Wall {
  Real inner, outer;
};

/// Solves dP_r/dR + (D - 1) (P_r - P_t)/R = 0 with P_r = - p (r/R)^(D-1) inside and 0 outside. The
/// law is P_k = mu (s_k - 1/s_k) + lambda (J - 1) J/s_k for the stretches s. Integrates from the
/// inside by the classical Runge-Kutta method of fourth order, and finds the inner radius by
/// bisection.
Wall exact_wall(int D, Real p) {
  constexpr Real mu = 1, lambda = 1.5, a = 0.5, b = 1;
  constexpr int steps = 400;
  const int k = D - 1;
  const auto stretch = [&](Real P, Real t) {  // along the radius
    const Real c = std::pow(t, k);
    Real s = 1;  // mu (s - 1/s) + lambda (c s - 1) c = P
    for (int n = 0; n < 30; ++n)
      s -= (mu * (s - 1 / s) + lambda * (c * s - 1) * c - P) /
           (mu * (1 + 1 / (s * s)) + lambda * c * c);
    return s;
  };
  struct Slope {
    Real r, P;
  };
  const auto slope = [&](Real R, Real r, Real P) {
    const Real t = r / R, s = stretch(P, t), J = s * std::pow(t, k);
    return Slope{s, -k * (P - mu * (t - 1 / t) - lambda * (J - 1) * J / t) / R};
  };
  const auto at_outside = [&](Real inner) {
    Real r = inner, P = -p * std::pow(inner / a, k), R = a;
    const Real h = (b - a) / steps;
    for (int n = 0; n < steps; ++n, R += h) {
      const Slope k1 = slope(R, r, P), k2 = slope(R + h / 2, r + h / 2 * k1.r, P + h / 2 * k1.P),
                  k3 = slope(R + h / 2, r + h / 2 * k2.r, P + h / 2 * k2.P),
                  k4 = slope(R + h, r + h * k3.r, P + h * k3.P);
      r += h / 6 * (k1.r + 2 * k2.r + 2 * k3.r + k4.r);
      P += h / 6 * (k1.P + 2 * k2.P + 2 * k3.P + k4.P);
    }
    return Slope{r, P};
  };
  Real low = a, high = 1.6 * a;
  for (int n = 0; n < 60; ++n) {
    const Real middle = (low + high) / 2;
    (at_outside(middle).P < 0 ? low : high) = middle;
  }
  return {low, at_outside(low).r};
}

template <int D>
Wall found_wall(const std::string& heading, const std::string& shape, const std::string& pressure) {
  Scene<D> scene = test::scene_of<D>(fmt::format(
      "dimension = {}\n[time]\n{}\n[[body]]\nname = \"wall\"\nradius = 1\nthickness = "
      "0.5\n{}\nmaterial = {{ type = \"neo_hookean\", density = 1, mu = 1, lambda = 1.5 "
      "}}\n{}",
      D, heading, shape, pressure));
  Simulation<D> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  const auto measure = [&](const std::string& name) {
    for (const MeasureSource& m : scene.measures)
      if (m.name == name) return m.compute(simulation.state().motion());
    throw std::logic_error(name);
  };
  return {0.5 * std::pow(measure("wall.cavity_fraction"), 1.0 / D), measure("wall.extent_y") / 2};
}

const std::string by_newton = "solver = \"newton\"\nend = 1\nstep = 0.25";

std::string ring(int around) {
  return fmt::format("shape = \"ring\"\naround = {}\nlayers = {}", around, around / 6);
}

/// The pressure in the cavity has an energy; solved by Newton's method.
TEST(HeldEquilibria, InflateThickWallsAsFarAsTheExactSolution) {
  const std::string filling = "[[cavity]]\nbody = \"wall\"\nramp = [0, 1]\npressure = ";
  const Wall exact = exact_wall(2, 0.4);
  EXPECT_NEAR(exact.inner, 0.7492259, 1e-7);  // by scipy.integrate.solve_ivp
  const Wall coarse = found_wall<2>(by_newton, ring(24), filling + "0.4\n"),
             fine = found_wall<2>(by_newton, ring(48), filling + "0.4\n");
  EXPECT_NEAR(fine.inner / exact.inner, 1, 1e-3);
  EXPECT_NEAR(fine.outer / exact.outer, 1, 3e-4);
  EXPECT_LT(std::abs(fine.inner / exact.inner - 1), 0.5 * std::abs(coarse.inner / exact.inner - 1));
  const std::string sphere = "shape = \"sphere_shell\"\nlayers = 4\nspacing = 0.4";
  const Wall found = found_wall<3>(by_newton, sphere, filling + "0.5\n");
  EXPECT_NEAR(found.inner / exact_wall(3, 0.5).inner, 1, 0.015);
}

/// A quarter of the wall between two planes of symmetry, in which its edges slide, with the
/// pressure as a traction; solved by Newton's method.
TEST(HeldEquilibria, InflateAQuarterOfAThickWall) {
  const auto error = [](int cells) {
    Scene<2> scene = test::scene_of<2>(fmt::format(
        "dimension = 2\n[time]\n{}\n[[body]]\nname = \"wall\"\nshape = \"rectangle\"\nsize = "
        "[0.5, 1.5707963267948966]\ncorner = [0.5, 0]\ncells = [{}, {}]\nmap = [\"x*cos(y)\", "
        "\"x*sin(y)\"]\nmaterial = {{ type = \"neo_hookean\", density = 1, mu = 1, lambda = 1.5 "
        "}}\n[[held]]\nbody = \"wall\"\nface = \"y_min\"\ncomponents = [\"y\"]\n[[held]]\nbody = "
        "\"wall\"\nface = \"y_max\"\ncomponents = [\"x\"]\n[[traction]]\nbody = \"wall\"\nface = "
        "\"x_min\"\npressure = 0.4\nramp = [0, 1]\n",
        by_newton, cells, 3 * cells));
    Simulation<2> simulation(scene);
    simulation.begin();
    while (!simulation.finished()) simulation.advance();
    for (const MeasureSource& m : scene.measures)
      if (m.name == "wall.extent_y")
        return m.compute(simulation.state().motion()) / exact_wall(2, 0.4).outer - 1;
    throw std::logic_error("no extent");
  };
  const Real coarse = error(4), fine = error(8);
  EXPECT_LT(std::abs(fine), 3e-4);
  EXPECT_LT(std::abs(fine), 0.5 * std::abs(coarse));
}

/// The pressure is a traction that follows the surface; solved by relaxation. The error is of
/// second order.
TEST(HeldEquilibria, InflateAThickWallByATractionThatFollowsIt) {
  const auto error = [](int around) {
    const Wall found = found_wall<2>(
        "end = 400\nsolver = \"relax\"\nforce_tolerance = 1e-6\nshape_tolerance = 1e-7",
        ring(around),
        "[[traction]]\nbody = \"wall\"\nface = \"inner\"\npressure = 0.4\nramp = [0, "
        "5]\n[[cavity]]\nbody = \"wall\"\n");
    return found.inner / exact_wall(2, 0.4).inner - 1;
  };
  const Real coarse = error(48), fine = error(96);
  EXPECT_LT(std::abs(fine), 1e-4);
  EXPECT_NEAR(coarse / fine, 4, 0.8);
}

}  // namespace
}  // namespace meniscus::test_held_equilibria
