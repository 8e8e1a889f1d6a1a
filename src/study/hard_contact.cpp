// SPDX-License-Identifier: BSD-3-Clause
// Hard cases of contact: fast first contact, a tip smaller than sigma0, strong compression,
// overlap, and the friction between flat surfaces with matching points (CGCM notes 7, 8 and 10).
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"
#include "physics/contact/contact_numbers.hpp"
#include "run/simulation.hpp"
#include "study/support/hard_cases.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus::study {
namespace {

constexpr const char* solid = "neo_hookean\", density = 1, mu = 400, lambda = 300";

std::string disk(const std::string& name, Real radius, const std::string& more) {
  return fmt::format(
      "[[body]]\nname = \"{}\"\nshape = \"disk\"\nradius = {}\ncore = 6\nrings = 3\n"
      "support_spacings = 2.2\n{}\nmaterial = {{ type = \"{} }}\n",
      name, radius, more, solid);
}

std::string contact(const std::string& bodies, const std::string& more) {
  return "[[contact]]\nname = \"contact\"\nbodies = " + bodies +
         "\nepsilon = 4\nsigma0 = 0.4\nbeta = 1\npoints = 3\n" + more + "\n";
}

std::string header(Real end) {
  return fmt::format("dimension = 2\n[time]\nend = {}\n", end);
}

/// Requires that the smallest gap of a run in which bodies meet is in the range `allowed`.
void met(HardCases& cases, const std::string& name, const HardOutcome& outcome, Range allowed) {
  const auto gap = outcome.least.find("contact.gap");
  cases.require(name, "least gap / sigma0",
                gap == outcome.least.end() ? std::nan("") : gap->second / 0.4, allowed);
}

void first_contact(HardCases& cases) {
  const Real c = std::sqrt(1100.0);  // speed of compression waves
  const std::string name = "first contact at 0.1 c";
  const HardOutcome outcome = cases.stays_stable(
      name,
      header(1) +
          disk("left", 1, fmt::format("centre = [-1.5, 0]\ninitial_velocity = [{}, 0]", 0.05 * c)) +
          disk("right", 1,
               fmt::format("centre = [1.5, 0.2]\ninitial_velocity = [{}, 0]", -0.05 * c)) +
          contact("[\"left\", \"right\"]", "least_gap = 0.2"),
      5e-3, {.watched = {"contact.gap"}});
  met(cases, name, outcome, {0.2, 0.4});
}

void small_tip(HardCases& cases) {
  const std::string name = "tip of radius 0.6 sigma0";
  const HardOutcome outcome = cases.stays_stable(
      name,
      header(1) + disk("tip", 0.24, "centre = [0, 0.9]\ninitial_velocity = [0, -1]\n") +
          contact("[\"tip\"]",
                  "partner = { type = \"half_space\", point = [0, 0], normal = [0, 1] }"),
      1e-3, {.watched = {"contact.gap"}});
  met(cases, name, outcome, {0.3, 0.637});
}

/// A block between two plates, at first at the equilibrium gap g*. sigma0 is 1/50 of the spacing of
/// particles, so the stiffness of contact governs the step. The pressure of the plates at 0.6 g* is
/// 384 epsilon sigma0^3 (CGCM note 3.1), which compresses the block by a sixth. K(0.6 g*) / K(g*) =
/// 244 (CGCM note 8), so the step falls by a factor of up to sqrt(244) = 15.6.
void compression(HardCases& cases) {
  constexpr Real sigma0 = 0.01, modulus = 2000;  // epsilon sigma0^3 = 1
  const Real gap = sigma0 * std::pow(15, -1.0 / 6);
  const auto plate = [&](const std::string& name, int side, const std::string& motion) {
    return fmt::format(
        "[[contact]]\nname = \"{}\"\nbodies = [\"block\"]\nepsilon = {}\nsigma0 = {}\nbeta = 1\n"
        "partner = {{ type = \"half_space\", point = [0, {}], normal = [0, {}]{} }}\n",
        name, std::pow(sigma0, -3), sigma0, side * (0.5 + gap), -side, motion);
  };
  const std::string name = "compression to 0.6 of the equilibrium gap";
  const HardOutcome outcome = cases.stays_stable(
      name,
      header(0.25) +
          fmt::format("[[body]]\nname = \"block\"\nshape = \"rectangle\"\nsize = [1, 1]\n"
                      "spacing = 0.5\nmaterial = {{ type = \"neo_hookean\", density = 1, mu = {}, "
                      "lambda = 0 }}\n",
                      modulus / 2) +
          plate("upper", 1, ", displacement = [0, \"-0.0888*(1 - cos(4*pi*t))\"]") +
          plate("lower", -1, ""),
      1e-2, {.watched = {"lower.gap"}});
  const auto least = outcome.least.find("lower.gap");
  cases.require(name, "least gap / equilibrium gap",
                least == outcome.least.end() ? std::nan("") : least->second / gap, {0.56, 0.62});
  cases.require(name, "step allowed at the equilibrium gap / least allowed step",
                outcome.first_allowed_step / outcome.least_allowed_step, {10, 20});
}

/// Momentum p of a body and angular momentum L about its own centre.
struct Thrown {
  Vec<3> p = Vec<3>::Zero(), L = Vec<3>::Zero();
};

template <int D>
Thrown thrown(const Body<D>& body, const State& state) {
  const auto vector = [](const Lanes& x) { return Vec<3>(x[0], x[1], x[2]); };
  const auto place = [&](Index A) {
    Vec<3> x = vector(at(state.u, body.first + A));
    x.template head<D>() += at(body.particles.X(), A);
    return x;
  };
  Thrown sum;
  Vec<3> centre = Vec<3>::Zero();
  Real mass = 0;
  for (Index A = 0; A < body.size(); ++A) {
    mass += at(body.mass, A);
    centre += at(body.mass, A) * place(A);
  }
  centre /= mass;
  for (Index A = 0; A < body.size(); ++A) {
    const Vec<3> p = at(body.mass, A) * vector(at(state.v, body.first + A));
    sum.p += p;
    sum.L += cross(place(A) - centre, p);
  }
  return sum;
}

/// Collides two bodies of radius 1 without friction, with an impact parameter of 0.6 in a direction
/// that differs from their lattices. Angular momentum L that they gain is an error (CGCM note 10).
template <int D>
void without_friction(HardCases& cases, const std::string& name, const std::string& shape,
                      Real bound) {
  if (!cases.wants(name)) return;
  const std::string aside = D == 3 ? "0.24, 0.18" : "0.3";
  const std::string back = D == 3 ? "-0.24, -0.18" : "-0.3", still = D == 3 ? "0, 0" : "0";
  const auto one = [&](const char* body, const std::string& centre, const char* speed) {
    return fmt::format(
        "[[body]]\nname = \"{}\"\n{}\ncentre = [{}]\ninitial_velocity = [{}, {}]\nmaterial = {{ "
        "type = \"neo_hookean\", density = 1, mu = 384.6, lambda = 576.9 }}\n",
        body, shape, centre, speed, still);
  };
  const Stopwatch clock;
  HardOutcome outcome;
  Thrown before, after;
  try {
    const SceneInput input = SceneInput::from_text(
        fmt::format("dimension = {}\ntime = {{ end = 4 }}\n", D) +
        one("left", "-1.5, " + back, "0.5") + one("right", "1.5, " + aside, "-0.5") +
        fmt::format("[[contact]]\nbodies = [\"left\", \"right\"]\nepsilon = {}\nsigma0 = 0.4\n"
                    "beta = 1\n",
                    D == 3 ? 100 : 40));
    scene_dimension(input);
    Scene<D> scene = build_scene<D>(input);
    outcome.particles = scene.system.size();
    Simulation<D> simulation(scene);
    const Body<D>& left = scene.system.bodies.front();
    before = thrown(left, simulation.state());
    simulation.begin();
    for (; !simulation.finished(); ++outcome.steps) simulation.advance();
    outcome.energy_error = outcome.final_energy_error =
        std::abs(simulation.audit().balance_error(simulation.audit_now()));
    after = thrown(left, simulation.state());
  } catch (const SolveError& e) {
    outcome.stopped = e.what();
  }
  cases.record(name, outcome, clock.seconds());
  cases.require(name, "runs to its end", outcome.stopped.empty(), {1, 1});
  cases.require(name, "spin / (radius x momentum exchanged)",
                after.L.norm() / (after.p - before.p).norm(), {0, bound});
}

void overlap(HardCases& cases) {
  cases.stops("start in overlap",
              header(1) + disk("left", 1, "centre = [-1, 0]") +
                  disk("right", 1, "centre = [1.05, 0]") + contact("[\"left\", \"right\"]", ""),
              "surfaces overlap");
}

/// Artificial friction: the largest lateral force between two flat surfaces with the same, shifted
/// lattice of points, relative to their peak attraction.
Real pinning(Real spacing_per_gap) {
  ContactLaw law;
  law.cutoff = 4;
  const PairLaw<PairKernel::space> pair(law);
  const Real gap = plane_contact(law, 1).equilibrium_gap, h = spacing_per_gap * gap;
  const int reach = static_cast<int>(std::ceil(law.reach() / h)) + 1;
  Real largest = 0;
  for (int shift = 0; shift < 16; ++shift) {
    Real force = 0;  // per area: V.W = -h^4, T = psi V.W r
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j) {
        const Real x = (i + shift / 16.0) * h, y = j * h;
        const Real square = x * x + y * y + gap * gap;
        if (square < law.reach() * law.reach()) force += pair.surface(square).psi * x * h * h;
      }
    largest = std::max(largest, std::abs(force));
  }
  return largest / plane_contact(law, 1).peak_traction;
}

/// Flat lattices of points in registry hold each other at coarse spacings, but hardly for h <= gap
/// / 2.
void registry(HardCases& cases) {
  if (!cases.wants("lattices in registry")) return;
  for (const Real ratio : {0.4, 0.5, 0.75, 1.0})
    cases.study().note(
        fmt::format("flat lattices in registry at the equilibrium gap, h/gap = {}: lateral "
                    "force up to {:.2g} of the peak traction",
                    ratio, pinning(ratio)));
  cases.require("lattices in registry", "lateral force / peak traction at h/gap = 0.4",
                pinning(0.4), {0, 2e-3});
  cases.require("lattices in registry", "the same at h/gap = 0.5", pinning(0.5), {0, 0.02});
  cases.require("lattices in registry", "the same at h/gap = 1 (pinned)", pinning(1), {0.3, 1});
}

}  // namespace

void hard_contact(HardCases& cases) {
  without_friction<2>(cases, "disks without friction",
                      "shape = \"disk\"\nradius = 1\ncore = 6\nrings = 3", 1e-3);
  if (!cases.study().brief()) {
    // Supports are wider than the default for solids, 1.5: with the default, balls of core = 6 have
    // an error of 1.7e-3.
    for (const auto& [core, bound] : {std::pair{4, 5e-2}, {6, 1e-3}})
      without_friction<3>(
          cases, fmt::format("balls without friction, core = {}", core),
          fmt::format("shape = \"ball\"\nradius = 1\nsupport_factor = 1.8\ncore = {}\nlayers = {}",
                      core, core / 2),
          bound);
  }
  first_contact(cases);
  small_tip(cases);
  compression(cases);
  overlap(cases);
  registry(cases);
}

}  // namespace meniscus::study
