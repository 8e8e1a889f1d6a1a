// SPDX-License-Identifier: BSD-3-Clause
// Two half discs that slide past each other (Fan 2014, section 5.1), reproducing table 5.1. For
// stiff discs with known force: pairs and time of one force with its tangent, by surface points and
// by volume points at equal accuracy. For soft discs: the work of each form on the way to the
// middle.
#include "body/grid/gauss.hpp"
#include "run/simulation.hpp"
#include "study/study.hpp"
#include "study/support/contact_costs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus::sliding_study {
namespace {

/// The law of inputs/contact/sliding_half_discs.toml, R0 = E0 = 1.
ContactLaw law() {
  ContactLaw law;
  law.kernel = PairKernel::integrated;
  law.epsilon = 1.5;
  law.sigma0 = 0.15;
  law.cutoff = 12;
  return law;
}

/// Distance between the bases of stiff discs; soft discs come equally close.
constexpr Real distance = 2.08;
constexpr std::array<Real, 6> offsets{-1, -0.7, -0.5, -0.3, -0.1, 0};

std::string half_disc(const std::string& name, int core, bool upper, Real x, Real y) {
  return fmt::format(
      "[[body]]\nname = \"{}\"\nshape = \"half_disk\"\nradius = 1\ncore = {}\nrings = {}\n"
      "below = {}\ncentre = [{:.17g}, {:.17g}]\n[body.material]\ntype = \"neo_hookean\"\n"
      "density = 1\nmu = 0.4166666666666667\nlambda = 0.2777777777777778\n",
      name, core, 2 * core / 3, upper, x, y);
}

/// The boundary of the lower half disc: points with their normals times weights. The upper half
/// disc is the lower one rotated by half a turn.
struct Boundary {
  std::vector<Vec<2>> x, V;

  Boundary() {
    const GaussRule& rule = gauss_rule(8);
    constexpr int arcs = 160, pieces = 60;
    const auto add = [&](int n, auto&& point) {
      for (int k = 0; k < n; ++k)
        for (std::size_t q = 0; q < rule.x.size(); ++q)
          point((k + 0.5 * (1 + rule.x[q])) / n, rule.w[q] / (2 * n));
    };
    add(arcs, [&](Real s, Real weight) {
      const Vec<2> n(std::cos(std::numbers::pi * s), std::sin(std::numbers::pi * s));
      x.push_back(n);
      V.push_back(std::numbers::pi * weight * n);
    });
    add(pieces, [&](Real s, Real weight) {
      x.emplace_back(2 * s - 1, 0);
      V.emplace_back(0, -2 * weight);
    });
  }
};

/// Exact values for stiff discs: energy, and force on the upper one, from E = INT INT u V.W.
struct Exact {
  Real energy = 0;
  Vec<2> force = Vec<2>::Zero();
};
Exact exact_at(const Boundary& boundary, Real offset) {
  const PairLaw<PairKernel::integrated> pair(law());
  Exact sum;
  for (std::size_t a = 0; a < boundary.x.size(); ++a)
    for (std::size_t b = 0; b < boundary.x.size(); ++b) {
      const Vec<2> r = Vec<2>(offset, distance) - boundary.x[a] - boundary.x[b];
      const Real weight = -boundary.V[a].dot(boundary.V[b]);
      const auto [u, psi] = pair.surface(r.squaredNorm());
      sum.energy += u * weight;
      sum.force -= psi * weight * r;
    }
  return sum;
}

struct Method {
  std::string name;
  ContactForm form;
  int points;
};

std::vector<Method> methods() {
  return {{"surface, energy form", ContactForm::energy, 2},
          {"surface, dissertation's form", ContactForm::dissertation, 2},
          {"volume, 1 point", ContactForm::volume, 1},
          {"volume, 2^2 points", ContactForm::volume, 2}};
}

std::unique_ptr<ForceTerm> contact(const System<2>& system, const Method& method) {
  ContactChoice choice;
  choice.form = method.form;
  choice.points = method.points;
  if (method.form == ContactForm::volume) choice.density = SiteDensity::referential;
  return contact_pair<2>({system.bodies[1], 1}, {system.bodies[0], 1}, law(), choice);
}

Vec<2> force_on_upper(const System<2>& system, const NodalVectors& force) {
  Vec<2> net = Vec<2>::Zero();
  const Body<2>& upper = system.bodies[1];
  for (Index A = upper.first; A < upper.first + upper.size(); ++A)
    for (int i = 0; i < 2; ++i) net[i] += at(force, A)[i];
  return net;
}

/// The shortest time of three calls.
template <class F>
double fastest(F&& f) {
  double least = unbounded;
  for (int k = 0; k < 3; ++k) {
    const Stopwatch one;
    f();
    least = std::min(least, one.seconds());
  }
  return least;
}

Measurement measure(Scene<2>& scene, const Method& method, int level,
                    const std::vector<Exact>& exact) {
  System<2>& system = scene.system;
  Measurement m{.method = method.name, .level = level, .particles = system.size()};
  const Stopwatch set_up;
  const auto term = contact(system, method);
  m.set_up = set_up.seconds();
  m.bytes = term->bytes();
  const NodalVectors still(static_cast<std::size_t>(system.size()), Lanes::zero());
  NodalVectors u = still, force = still, mirrored = still;
  const auto move = [&](Real offset) {
    for (NodalVector& w : system.bodies[1].part(std::span(u))) w = Lanes(offset, 0, 0, 0);
  };
  Real squares = 0, energies = 0, most = 0, deepest = 0, seconds = 0;
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    move(offsets[k]);
    force = still;
    term->add_force({0, u, still}, force);
    const Vec<2> error = force_on_upper(system, force) - exact[k].force;
    squares += error.squaredNorm();
    most = std::max(most, exact[k].force.norm());
    if (const auto E = term->stored_energy({0, u, still}))
      energies += std::pow(*E - exact[k].energy, 2);
    deepest = std::max(deepest, std::abs(exact[k].energy));
    seconds += fastest([&] {
                 term->add_force({0, u, still}, force);
                 term->add_tangent({0, u, still}, {0, u, still}, mirrored);
               }) /
               offsets.size();
  }
  const auto [pairs, spacing] = study::contact_cost(system.bodies[1], system.bodies[0], method.form,
                                                    method.points, law(), 0.4 * law().sigma0, u);
  m.time = seconds;
  m.h = spacing;
  m.errors = {{"force", std::sqrt(squares / offsets.size()) / most},
              {"energy", std::sqrt(energies / offsets.size()) / deepest}};
  m.values = {{"pairs", pairs},
              {"h / gap", spacing / (distance - 2)},
              {"ns per pair", 1e9 * seconds / pairs}};
  return m;
}

/// Pairs and time of a force with a given error, interpolated between the measurements of a method
/// by powers. Returns the coarsest measurement if it is accurate enough.
std::optional<std::pair<Real, Real>> cost_of(const StudyRun& study, const std::string& method,
                                             Real error) {
  const Measurement* before = nullptr;
  for (const Measurement& m : study.measurements()) {
    if (m.method != method) continue;
    const Real pairs = m.values.front().second, own = m.error("force");
    if (own <= error) {
      if (!before) return std::pair(pairs, m.time);
      const Real s =
          std::log(error / before->error("force")) / std::log(own / before->error("force"));
      const auto between = [s](Real a, Real b) { return a * std::pow(b / a, s); };
      return std::pair(between(before->values.front().second, pairs),
                       between(before->time, m.time));
    }
    before = &m;
  }
  return std::nullopt;
}

void compare_at_equal_accuracy(StudyRun& study) {
  const std::string surface = methods().front().name;
  for (const Method& method : methods()) {
    if (method.form != ContactForm::volume) continue;
    for (const int level : study.levels()) {
      const Measurement& m = *study.find(method.name, level);
      const Real pairs = m.values.front().second, error = m.error("force");
      const auto cost = cost_of(study, surface, error);
      if (!cost) continue;
      study.note(fmt::format(
          "{}, {}: error {:.2g} with {:.2g} pairs in {:.2g} s; surface: {:.2g} pairs in {:.2g} s, "
          "{:.0f} times fewer, {:.0f} times as fast",
          method.name, level, error, pairs, m.time, cost->first, cost->second, pairs / cost->first,
          m.time / cost->second));
      if (level == study.levels().back())
        study.require(method.name + ": pairs / those of the surface at equal accuracy",
                      pairs / cost->first, {20, unbounded});
    }
  }
}

/// Soft discs on their way to the middle, through equilibria of the energy form.
struct Way {
  Scene<2> scene;
  std::vector<NodalVectors> u;

  explicit Way(int core)
      : scene([&] {
          const SceneInput input = SceneInput::from_text(
              "dimension = 2\n[time]\nsolver = \"newton\"\nend = 1.5\nstep = 0.02\n" +
              half_disc("lower", core, false, 0, 0) + half_disc("upper", core, true, -1.5, 2) +
              "[[held]]\nname = \"base\"\nbody = \"lower\"\nface = \"flat\"\n"
              "[[held]]\nname = \"grip\"\nbody = \"upper\"\nface = \"flat\"\n"
              "displacement = [\"t\", 0]\n"
              "[[contact]]\nname = \"discs\"\nbodies = [\"upper\", \"lower\"]\nepsilon = 1.5\n"
              "sigma0 = 0.15\nbeta = 1\ncutoff = 12\n");
          scene_dimension(input);
          return build_scene<2>(input);
        }()) {
    Simulation<2> simulation(scene);
    simulation.begin();
    simulation.settle();
    u.push_back(simulation.state().u);
    while (!simulation.finished()) {
      simulation.advance();
      u.push_back(simulation.state().u);
    }
  }

  /// The work of a term along straight paths between the states, by Simpson's rule with `pieces`
  /// pieces.
  Real work(ForceTerm& term, int pieces) const {
    const NodalVectors still(u.front().size(), Lanes::zero());
    NodalVectors place = still, way = still, force;
    Real work = 0;
    for (std::size_t k = 1; k < u.size(); ++k) {
      for (std::size_t A = 0; A < way.size(); ++A) way[A] = u[k][A] - u[k - 1][A];
      for (int j = 0; j <= 2 * pieces; ++j) {
        const Real part = j / (2.0 * pieces);
        for (std::size_t A = 0; A < way.size(); ++A) place[A] = u[k - 1][A] + part * way[A];
        force = still;
        term.add_force({0, place, still}, force);
        Real power = 0;
        for (std::size_t A = 0; A < way.size(); ++A) power += sum(force[A] * way[A]);
        const Real weight = j == 0 || j == 2 * pieces ? 1 : j % 2 ? 4 : 2;
        work += weight * power / (6 * pieces);
      }
    }
    return work;
  }
};

/// Compares the work of each form on the way with the change of its energy. Forms without an energy
/// are compared with the energy form.
void compare_on_the_way(StudyRun& study, int core) {
  const Stopwatch clock;
  Way way(core);
  const double seconds = clock.seconds();
  const NodalVectors still(way.u.front().size(), Lanes::zero());
  Real released = 0, most = 0;
  Vec<2> force_of_energy = Vec<2>::Zero();
  for (const Method& method : methods()) {
    if (method.points == 1) continue;
    const auto term = contact(way.scene.system, method);
    const auto energy = [&](const NodalVectors& u) {
      return term->stored_energy({0, u, still}).value_or(0);
    };
    const bool has_energy = term->potential({0, still, still}).has_value();
    if (has_energy) released = energy(way.u.front()) - energy(way.u.back());
    const Stopwatch work_clock;
    const Real work = way.work(*term, method.form == ContactForm::volume ? 1 : 4);
    NodalVectors force = still;
    term->add_force({0, way.u[60], still}, force);  // offset -0.3
    const Vec<2> net = force_on_upper(way.scene.system, force);
    if (method.form == ContactForm::energy) {
      force_of_energy = net;
      most = net.norm();
    }
    Measurement m{.method = "way to the middle, " + method.name,
                  .level = core,
                  .particles = way.scene.system.size()};
    m.h = 1.0 / core;
    m.set_up = seconds;
    m.time = work_clock.seconds();
    m.errors = {{"work / energy", work / released - 1}};
    m.values = {{"force along at -0.3", -net[0]},
                {"off that of the energy form", (net - force_of_energy).norm() / most}};
    study.record(m);
    const std::string where =
        fmt::format("{}, core {}: work to the middle / energy - 1", method.name, core);
    if (has_energy)
      study.require(where, m.errors.front().second, {-2e-4, 2e-4});
    else
      study.require(where + ", lost", std::abs(m.errors.front().second), {1e-3, 1});
  }
}

void run(StudyRun& study) {
  study.finish_settings();
  const Boundary boundary;
  std::vector<Exact> exact;
  for (const Real offset : offsets) exact.push_back(exact_at(boundary, offset));
  for (const int level : study.levels()) {
    const SceneInput input = SceneInput::from_text("dimension = 2\n[time]\nend = 1\n" +
                                                   half_disc("lower", level, false, 0, 0) +
                                                   half_disc("upper", level, true, 0, distance));
    scene_dimension(input);
    Scene<2> scene = build_scene<2>(input);
    for (const Method& method : methods()) study.record(measure(scene, method, level, exact));
  }
  compare_at_equal_accuracy(study);
  const std::string surface = methods().front().name;
  study.require("order of the surface, energy form", study.overall_order(surface, "force"),
                {3, 12});
  study.require("order of the volume, 2^2 points",
                study.overall_order("volume, 2^2 points", "force"), {1, 4});
  for (const Measurement& m : study.measurements())
    if (m.method == surface && m.values[1].second < 0.35)
      study.require(fmt::format("error at h/gap = {:.2f}, {}", m.values[1].second, m.method),
                    m.error("force"), {0, 0.01});
  compare_on_the_way(study, 12);
}

const bool registered = register_entry(
    StudyEntry{"sliding",
               "table 5.1 of the dissertation anew: contact of half discs by surface and volume "
               "points at equal accuracy, and the work of a pass",
               "cells along the core of a half disc, a multiple of 6",
               {6, 12, 18, 24, 36},
               {6, 12, 24},
               run});

}  // namespace
}  // namespace meniscus::sliding_study
