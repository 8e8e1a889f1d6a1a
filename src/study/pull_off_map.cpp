// SPDX-License-Identifier: BSD-3-Clause
// Pull-off map: a soft half sphere and an adhesive plate that comes and goes away by equilibria,
// for several Tabor numbers. The pull-off force against Maugis & Dugdale between those of stiff
// (Bradley) and soft spheres (Johnson, Kendall, Roberts), and the work of the cycle against what
// jumps release.
#include "meniscus/scene/simulation.hpp"
#include "meniscus/study/study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus::pull_off_map_study {
namespace {

constexpr Real pi = std::numbers::pi;

/// R = E* = 1. The gap of equilibrium is the smaller the less the surface has to be resolved; the
/// forces of stiff spheres differ by its part of R from those of paraboloids.
struct Case {
  Real tabor, gap, far;  ///< far: of the plate from the pole at both ends of the cycle

  Real adhesion() const { return std::pow(tabor * gap, 1.5); }
  Real sigma0() const { return gap * std::pow(15, 1.0 / 6); }
  Real epsilon() const { return adhesion() / (0.968479 * std::pow(sigma0(), 4)); }
};

std::string scene_text(const Case& c, int core) {
  return fmt::format(R"toml(
dimension = 3
[time]
solver = "newton"
end = 2
step = 0.05
[[body]]
name = "half"
shape = "half_sphere"
radius = 1
core = {}
layers = {}
support_spacings = 2.2
material = {{ type = "neo_hookean", density = 1, mu = 0.35, lambda = 0.525 }}
[[held]]
name = "base"
body = "half"
face = "flat"
[[contact]]
name = "tip"
bodies = ["half"]
epsilon = {:.17g}
sigma0 = {:.17g}
beta = 1
[contact.partner]
type = "half_space"
point = [0, 0, {:.17g}]
normal = [0, 0, -1]
displacement = [0, 0, "-{:.17g}*(1 - abs(t - 1))"]
)toml",
                     core, core / 2, c.epsilon(), c.sigma0(), 1 + c.far, c.far - c.gap);
}

/// Pull-off force over pi W R of Maugis (1992), lambda = 1.157 of the Tabor number: the largest
/// pull over the ratio m of the radii of the adhesive zone and of the contact.
Real maugis(Real tabor) {
  const Real lambda = 1.157 * tabor;
  Real most = 0;
  for (Real e = -6; e < 4; e += 1e-3) {
    const Real m = 1 + std::pow(10, e), s = std::sqrt(m * m - 1), angle = std::acos(1 / m);
    const Real A = lambda / 2 * ((m * m - 2) * angle + s),
               B = 4 * lambda * lambda / 3 * (s * angle - m + 1);
    const Real a = (-B + std::sqrt(B * B + 4 * A)) / (2 * A);
    most = std::max(most, lambda * a * a * (s + m * m * angle) - a * a * a);
  }
  return most;
}

/// Of the stiff half sphere, whose sections have the area pi (2 h - h^2) at the height h, by the
/// force of a half space on each (CGCM note 3.1); 2 pi W R for a gap that is small.
Real bradley(const Case& c) {
  const auto force = [&](Real gap) {
    const auto slope = [&](Real a) {
      const Real x = std::pow(c.sigma0() / a, 6);
      return pi * c.epsilon() * a * a * (x - x * x / 5);
    };
    constexpr int n = 4000;
    Real sum = 0;
    for (int k = 0; k < n; ++k) {  // h = t^3, midpoints
      const Real t = (k + 0.5) / n, h = t * t * t;
      sum += 3 * t * t / n * pi * (2 * h - h * h) * slope(gap + h);
    }
    return sum;
  };
  Real most = 0;
  for (Real part = 0.9; part < 1.3; part += 0.005) most = std::max(most, force(part * c.gap));
  return most;
}

Measurement cycle(const Case& c, int core) {
  const Stopwatch set_up;
  const SceneInput input = SceneInput::from_text(scene_text(c, core));
  scene_dimension(input);
  Scene<3> scene = build_scene<3>(input);
  Simulation<3> simulation(scene);
  simulation.begin();
  Measurement m{.method = fmt::format("Tabor number {:g}", c.tabor), .level = core};
  m.particles = scene.system.size();
  m.h = 1 / std::cbrt(Real(m.particles));
  m.bytes = scene.system.bytes();
  m.set_up = set_up.seconds();
  const Stopwatch run;
  const auto value = [&](std::string_view name) {
    return std::find_if(scene.measures.begin(), scene.measures.end(),
                        [&](const MeasureSource& s) { return s.name == name; })
        ->compute(simulation.state().motion());
  };
  Real pull = 0, exchanged = 0;
  try {
    simulation.settle();
    const Ledger first = simulation.audit_now();
    while (!simulation.finished()) {
      simulation.advance();
      pull = std::max(pull, value("tip.force_z"));
      exchanged = std::max(exchanged, std::abs(simulation.audit_now().external_work));
    }
    const Ledger last = simulation.audit_now();
    const Real released = last.dissipated - first.dissipated;
    const Real expected = maugis(c.tabor) / 2;
    m.errors = {{"pull-off force", pull / bradley(c) / expected - 1}};
    m.values = {{"pull-off / stiff", pull / bradley(c)},
                {"Maugis-Dugdale", expected},
                {"work of the cycle / largest", last.external_work / exchanged},
                {"released / largest", released / exchanged},
                {"gap at the end", value("tip.gap")}};
    for (const Residual& r : simulation.stepper().residuals(simulation.state()))
      if (r.meaning == "jumps") m.values.emplace_back("jumps", r.value);
  } catch (const SolveError& e) {
    m.remark = e.what();
  }
  m.time = run.seconds();
  return m;
}

void check(StudyRun& study, const Case& c) {
  const Measurement& m = study.measurements().back();
  const std::string where = fmt::format("{}, core {}: ", m.method, m.level);
  study.require(where + "went on to its end", m.remark.empty() ? 1 : 0, {1, 1});
  if (!m.remark.empty()) return;
  const auto value = [&](std::string_view name) {
    return std::find_if(m.values.begin(), m.values.end(),
                        [&](const auto& v) { return v.first == name; })
        ->second;
  };
  const Real work = value("work of the cycle / largest"), released = value("released / largest");
  if (c.tabor < 0.5) {
    study.require(where + "pull-off force / Maugis-Dugdale - 1", m.error("pull-off force"),
                  {-0.03, 0.03});
    study.require(where + "jumps", value("jumps"), {0, 0});
    study.require(where + "work of the cycle / largest", work, {-1e-5, 1e-5});
    return;
  }
  // JKR, and stiff.
  study.require(where + "pull-off force / stiff", value("pull-off / stiff"), {0.70, 1});
  if (c.tabor < 2) return;
  study.require(where + "jumps", value("jumps"), {2, unbounded});
  study.require(where + "work of the cycle / largest", work, {0.01, 1});
  study.require(where + "work of the cycle / released - 1", work / released - 1, {-0.03, 0.03});
}

void run(StudyRun& study) {
  study.finish_settings();
  for (const int level : study.levels())
    for (const Case& c : {Case{0.1, 0.1, 0.4}, {1, 0.05, 0.3}, {5, 0.05, 0.9}}) {
      if (study.brief() && c.tabor == 1) continue;
      study.record(cycle(c, level));
      check(study, c);
    }
}

const bool registered =
    register_entry(StudyEntry{"pull_off_map",
                              "pull-off force and hysteresis of a soft half sphere by Tabor number",
                              "cells along an edge of the core of the half sphere, even",
                              {4, 8, 12},
                              {4},
                              run});

}  // namespace
}  // namespace meniscus::pull_off_map_study
