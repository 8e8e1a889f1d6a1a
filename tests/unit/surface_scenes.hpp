// SPDX-License-Identifier: BSD-3-Clause
// Scenes of bodies with surface laws and known solutions, in units R = rho = gamma = 1.
#pragma once
#include "cases.hpp"
#include "cells_reference.hpp"
#include "meniscus/physics/surface_registry.hpp"
#include "run/simulation.hpp"
#include "support.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>

namespace meniscus::test {

template <int D>
Real measured(const Scene<D>& scene, const State& state, const std::string& name) {
  for (const MeasureSource& measure : scene.measures)
    if (measure.name == name) return measure.compute(state.motion());
  throw std::runtime_error("no measure " + name);
}

/// The lines of a ball (disk) with these numbers of core and layers (2D: rings). 6, 3 are 997
/// particles; 4, 2 are 321.
inline std::string ball_of(int D, int core, int layers, Real radius = 1) {
  return fmt::format(
      "[[body]]\nname = \"b\"\nshape = \"{}\"\nradius = {:.17g}\ncore = {}\n{} = {}\n",
      D == 3 ? "ball" : "disk", radius, core, D == 3 ? "layers" : "rings", layers);
}

inline std::string law_of(const std::string& type, const std::string& numbers) {
  return "[[surface]]\nbody = \"b\"\n[surface.law]\ntype = \"" + type + "\"\n" + numbers;
}

/// The term of a surface law on a body, with Gauss points per direction and facet.
template <int D>
std::unique_ptr<ForceTerm> surface_term(const Body<D>& body, const std::string& type,
                                        const std::string& numbers, int points = 3) {
  const SceneInput input = SceneInput::from_text("[law]\n" + numbers);
  const auto table = input.root().table("law");
  auto law = surface_laws().at(type).read(*table);
  input.check();
  return law->build(body, points);
}

/// At random displacements up to `size`, the forces of a term are minus the gradient of its energy
/// (differences with `step`), and have no net force and no net torque up to `balance`.
template <int D>
void expect_balanced_gradient(ForceTerm& term, const Body<D>& body, Real size, Real step,
                              Real balance) {
  const NodalVectors u = random_field<D>(body.size(), size, 3),
                     way = random_field<D>(body.size(), 1, 8);
  EXPECT_LT(gradient_error(term, u, way, step), 1e-8);
  const Balance net = balance_of<D>(body, u, force_of(term, u));
  EXPECT_LT(net.force, balance);
  EXPECT_LT(net.torque, balance);
}

/// Stretch v of the first body at which a uniform dilation x = v X is in equilibrium: the virtual
/// power sum_A f_A . X_A of the forces is zero. Found by the secant method.
template <int D>
Real stretch_without_power(Scene<D>& scene) {
  const Body<D>& body = scene.system.bodies.front();
  const NodalVectors X = field_on<D>(body, [](const Vec<D>&place) { return place; }),
                     still = zeros(X);
  const auto power = [&](Real v) {
    NodalVectors force = still;
    scene.system.add_up({0, sum_of(still, v - 1, X), still}, force);
    return test::dot(force, X);
  };
  Real before = 0.99, v = 1.01, last = power(before);
  for (int k = 0; k < 30 && std::abs(v - before) > 1e-13; ++k) {
    const Real now = power(v), next = v - now * (v - before) / (now - last);
    before = std::exchange(v, next);
    last = now;
  }
  return v;
}

/// The scene of a row of "ball_radial", without its pressure. A ball may be in the half plane.
template <int D>
std::string radial_scene(const nlohmann::json& row, int core, int layers) {
  const std::string dimension =
      row.at("d") == D ? std::to_string(D) : std::string("\"axisymmetric\"");
  const std::string bulk = row.at("bulk"), surface = row.at("surface");
  std::string text =
      fmt::format("dimension = {}\n[time]\nsolver = \"newton\"\nend = 1e3\n", dimension) +
      ball_of(D, core, layers) + "material = { density = 1, ";
  if (bulk == "log")
    text += "type = \"newtonian\", bulk_modulus = 150, viscosity = 1 }\n";
  else
    text += fmt::format("type = \"{}\", mu = 1, lambda = 1.5 }}\n",
                        bulk == "nh" ? "neo_hookean" : "st_venant_kirchhoff");
  text += law_of("tension", "gamma = 0.2\n");
  if (surface != "tension")
    text +=
        law_of(surface == "a" ? "gurtin_murdoch" : "neo_hookean_skin", "lambda = 0.4\nmu = 0.3\n");
  return text;
}

/// The stretch of the ball or disk at rest. The pressure of the surroundings is given as an energy.
template <int D>
Real radial_stretch(const nlohmann::json& row, int core, int layers) {
  std::string text = radial_scene<D>(row, core, layers);
  const Real p = row.at("p");
  if (p != 0)
    text += fmt::format("[[cavity]]\nbody = \"b\"\nsurface = \"outer\"\npressure = {:.17g}\n", -p);
  Scene<D> scene = scene_of<D>(text);
  Simulation<D> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  return measured(scene, simulation.state(), "b.radius");
}

/// Like radial_stretch(), with a traction that follows the surface and has no potential: the radial
/// motion without power.
template <int D>
Real radial_stretch_by_traction(const nlohmann::json& row, int core, int layers) {
  Scene<D> scene =
      scene_of<D>(radial_scene<D>(row, core, layers) +
                  fmt::format("[[traction]]\nbody = \"b\"\nwhere = 1\npressure = {:.17g}\n",
                              row.at("p").get<Real>()));
  return stretch_without_power(scene);
}

/// Relative error of the displacement of a ball in the tidal field, by `state_error`.
inline Real tidal_error(const nlohmann::json& row, int core, int layers) {
  constexpr Real beta = 1e-5;
  const auto number = [&](const char* key) { return std::stod(row.at(key).get<std::string>()); };
  const std::string Phi = "(z^2 - (x^2 + y^2)/2)", r2 = "(x^2 + y^2 + z^2)";
  std::string exact;
  for (const auto& [gradient, X] : {std::pair("(-x)", "x"), {"(-y)", "y"}, {"(2*z)", "z"}})
    exact += fmt::format("{}\"{:.17g}*(({:.17g} + {:.17g}*{})*{} + {:.17g}*{}*{})\"",
                         exact.empty() ? "" : ", ", beta, number("c1"), number("c2"), r2, gradient,
                         number("c3"), Phi, X);
  const std::string text =
      "dimension = 3\n[time]\nsolver = \"newton\"\nend = 1e3\nforce_tolerance = 1e-10\n" +
      ball_of(3, core, layers) +
      fmt::format("material = {{ type = \"neo_hookean\", density = 1, mu = {}, lambda = {} }}\n",
                  row.at("mu").get<Real>(), row.at("lam").get<Real>()) +
      law_of("gurtin_murdoch", fmt::format("lambda = {}\nmu = {}\n", row.at("la").get<Real>(),
                                           row.at("ms").get<Real>())) +
      fmt::format(
          "[[body_force]]\nbody = \"b\"\nacceleration = [\"-{0}*x\", \"-{0}*y\", "
          "\"2*{0}*z\"]\n",
          beta) +
      // A free body under pressing forces would turn over. Springs hold it and change the result by
      // 1e-4.
      "[[spring]]\nbody = \"b\"\nstiffness = 1e-4\n" +
      "[[exact]]\nbody = \"b\"\nrate = 1\ndisplacement = [" + exact + "]\nvelocity = [0, 0, 0]\n";
  Scene<3> scene = scene_of<3>(text);
  Simulation<3> simulation(scene);
  simulation.begin();
  while (!simulation.finished()) simulation.advance();
  return measured(scene, simulation.state(), "b.state_error");
}

/// A fluid drop (2D: disk) at its Laplace pressure (D - 1) = K (1 - J), with the current radius
/// one.
inline std::string resting_drop(int D, int core, int layers, Real viscosity,
                                const std::string& velocity, Real skin = 0) {
  constexpr Real bulk_modulus = 200;
  const Real J = 1 - (D - 1) / bulk_modulus, scale = std::pow(J, 1.0 / D),
             pull = skin * (scale * scale - 1) * (D == 3 ? 1 : scale / 2);
  std::string displacement;
  for (int i = 0; i < D; ++i)
    displacement += fmt::format("{}\"{:.17g}*{}\"", i ? ", " : "", scale - 1, "xyz"[i]);
  return ball_of(D, core, layers, 1 / scale) +
         fmt::format(
             "initial_displacement = [{}]\ninitial_velocity = [{}]\nmaterial = {{ type = "
             "\"newtonian\", density = {:.17g}, bulk_modulus = {}, equation_of_state = "
             "\"linear\", viscosity = {} }}\n[[surface_tension]]\nbody = \"b\"\ngamma = {:.17g}\n",
             displacement, velocity, J, bulk_modulus, viscosity, 1 - pull);
}

/// The rate sigma of samples that vary as exp(sigma k dt) and its conjugate, from the recursion
/// that fits them best.
inline Complex rate_of(const std::vector<Real>& x, Real dt) {
  Real aa = 0, ab = 0, bb = 0, ay = 0, by = 0;
  for (std::size_t k = 1; k + 1 < x.size(); ++k) {
    aa += x[k] * x[k];
    ab += x[k] * x[k - 1];
    bb += x[k - 1] * x[k - 1];
    ay += x[k] * x[k + 1];
    by += x[k - 1] * x[k + 1];
  }
  const Real p = (ay * bb - by * ab) / (aa * bb - ab * ab),
             q = (by * aa - ay * ab) / (aa * bb - ab * ab);
  return std::log(p / 2 + std::sqrt(Complex(p * p / 4 + q))) / dt;
}

/// Complex frequencies of the second mode of a drop that starts with the potential flow of this
/// mode: from the run, and from the exact initial-value problem.
struct Oscillation {
  Complex found, exact;
  Real error() const { return std::abs(found - exact) / std::abs(exact); }
};
template <int D>
Oscillation oscillation(const nlohmann::json& row, int core, int layers) {
  constexpr Real speed = 0.02;
  const Real mu_s = row.value("mu_s", 0.0),
             kappa_s = row.value("kappa_s", row.value("mu_s_plus_kappa_s", 0.0)),
             mu_e = row.value("mu_e", 0.0),
             lambda = row.value("lambda", row.value("lambda_plus_2mu", 0.0));
  std::string text =
      fmt::format("dimension = {}\n[time]\nend = 5\n", D) +
      resting_drop(D, core, layers, row.at("mu"),
                   D == 3 ? fmt::format("\"{1}*x\", \"-{0}*y\", \"-{0}*z\"", speed / 2, speed)
                          : fmt::format("\"{0}*x\", \"-{0}*y\"", speed),
                   lambda + mu_e);
  if (mu_s + kappa_s > 0)
    text +=
        law_of("boussinesq_scriven", fmt::format("shear = {}\ndilatational = {}\n", mu_s, kappa_s));
  if (lambda > 0)
    text += law_of("gurtin_murdoch", fmt::format("lambda = {}\nmu = {}\n", lambda, mu_e));
  Scene<D> scene = scene_of<D>(text);
  Simulation<D> simulation(scene);
  simulation.begin();
  const nlohmann::json& times = cells_reference().at("oscillation").at("times");
  std::vector<Real> found, exact;
  Real before = 0, time = 0;
  for (std::size_t k = 0; k < times.size();) {
    simulation.advance();
    const Real now = measured(scene, simulation.state(), "b.p2"), t = simulation.state().time;
    for (; k < times.size() && t >= times[k].get<Real>(); ++k) {
      if (times[k] < 1) continue;  // faster modes have decayed by then
      found.push_back(before + (now - before) * (times[k].get<Real>() - time) / (t - time));
      exact.push_back(speed * row.at("p2")[k].get<Real>());
    }
    before = now;
    time = t;
  }
  return {rate_of(found, 0.25), rate_of(exact, 0.25)};
}

/// The tension 1 + g P_l(cos(theta)) on the surface of a drop, with l = 1, or l = 2 in 3D; theta is
/// the angle to x.
struct MarangoniCase {
  int l = 1;
  Real mu = 0.5, mu_s = 0, kappa_s = 0;
  std::string of = "place";
  Real g = 1e-2;
};
/// Amplitude A of the flow from rest against time: its component along the exact flow, divided by
/// the exact amplitude. At the end also the velocity that is not along the exact flow, the shape,
/// and the error of the energy.
struct Marangoni {
  std::vector<Real> time, amplitude;
  Real beside = 0, shape = 0, balance = 0;
};
template <int D>
Marangoni marangoni(const MarangoniCase& drop, int core, int layers, Real until,
                    Real safety = 0.9) {
  const auto& [l, mu, mu_s, kappa_s, of, g] = drop;
  const Real exact = D == 2   ? g / (4 * mu + 2 * (mu_s + kappa_s))
                     : l == 1 ? g / (3 * mu + 2 * kappa_s)
                              : 3 * g / (5 * mu + 4 * mu_s + 6 * kappa_s);
  std::string text =
      fmt::format("dimension = {}\n[time]\nend = {}\nsafety = {}\n", D, until, safety) +
      resting_drop(D, core, layers, mu, D == 3 ? "0, 0, 0" : "0, 0") +
      law_of("varying_tension", fmt::format("of = \"{}\"\ngamma = \"{}*{}\"\n", of, g,
                                            l == 1 ? "x" : "(x^2 - (y^2 + z^2)/2)"));
  if (mu_s + kappa_s > 0)
    text +=
        law_of("boussinesq_scriven", fmt::format("shear = {}\ndilatational = {}\n", mu_s, kappa_s));
  Scene<D> scene = scene_of<D>(text);
  Simulation<D> simulation(scene);
  simulation.begin();
  const Body<D>& body = scene.system.bodies.front();
  const Real scale = 1 + scene.initial.u.front()[0] / at(body.particles.X(), 0)[0];
  const auto flow = [scale, l = l](const Vec<D>& X) -> Vec<D> {
    const Vec<D> x = scale * X, axis = Vec<D>::Unit(0);
    const Real r2 = x.squaredNorm();
    if (l == 2) return (5 * r2 - 3) / 6 * (3 * x[0] * axis - x) - (3 * x[0] * x[0] - r2) / 3 * x;
    return ((5 - D) * r2 - 1) * axis - (4 - D) * x[0] * x;
  };
  const NodalVectors w = field_on<D>(body, flow);
  const auto product = [&](const NodalVectors& a, const NodalVectors& b) {
    Real sum = 0;
    for (Index A = 0; A < body.size(); ++A)
      sum += at(body.mass, A) * meniscus::sum(at(a, A) * at(b, A));
    return sum;
  };
  Marangoni result;
  while (!simulation.finished()) {
    simulation.advance();
    result.time.push_back(simulation.state().time);
    result.amplitude.push_back(product(simulation.state().v, w) / product(w, w) / exact);
  }
  const NodalVectors rest = sum_of(simulation.state().v, -result.amplitude.back() * exact, w);
  result.beside = std::sqrt(product(rest, rest) / product(w, w)) / exact;
  const Ledger ledger = simulation.audit_now();
  result.shape = measured(scene, simulation.state(), "b.p2");
  result.balance = std::abs(simulation.audit().balance_error(ledger));
  return result;
}

}  // namespace meniscus::test
