// SPDX-License-Identifier: BSD-3-Clause
// A drop that spreads on a wall: base radius and contact angle against an axisymmetric
// finite-element calculation with the same law, and its residual motion at rest (wetting note).
#include "run/simulation.hpp"
#include "study/study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace meniscus::wetting_study {
namespace {

struct Case {
  int angle;  ///< contact angle in degrees
  const char* form;
  const char* viscosity;

  std::string name() const {
    return fmt::format("{} degrees, {} tension, {} viscosity", angle, form, viscosity);
  }
};

/// Base radius and contact angle (of the sphere that fits above 0.35 of the height) at t = 1, 2, 4,
/// 6. R = rho = gamma = Oh = 1, range 0.0785, offset 0.04; 600 elements. The calculation gives
/// angles at the film and radii by the area energy / adhesion; here they are at the wall and at the
/// sharp line, 0.010, 0.020, 0.023 below the film and 0.046, 0.012, -0.024 farther out for 60, 90,
/// 120 degrees (wetting note 12). With 150 elements radii differ by up to 1 % (120 degrees: 4 %) at
/// t <= 2 and 0.1 % (1.5 %) later, angles by up to 1.4 degrees.
struct Curve {
  int angle;
  std::array<Real, 4> radius, degrees;
};
constexpr std::array<Real, 4> times{1, 2, 4, 6};
constexpr std::array<Curve, 3> curves{
    Curve{60, {0.9827, 1.3516, 1.5824, 1.6141}, {149.6453, 102.6844, 65.7285, 60.8227}},
    Curve{90, {0.8103, 1.0809, 1.2488, 1.2681}, {155.0634, 119.7096, 93.9394, 90.3290}},
    Curve{120, {0.6314, 0.8068, 0.9066, 0.9206}, {161.4796, 135.1610, 121.9332, 120.3011}}};

std::string scene_text(const Case& c, int core, Real end) {
  return fmt::format(R"toml(
dimension = 3
time = {{ end = {:.17g}, viscosity = "{}" }}
[[body]]
name = "drop"
shape = "ball"
radius = 1
core = {}
layers = {}
[body.material]
type = "newtonian"
density = 1
bulk_modulus = 151
viscosity = 1
[[surface_tension]]
body = "drop"
gamma = 1
form = "{}"
[[contact]]
name = "wall"
bodies = ["drop"]
contact_angle = {}
offset = 0.04
range = 0.0785
points = 3
[contact.partner]
type = "half_space"
point = [0, 0, -1.06]
normal = [0, 0, 1]
)toml",
                     end, c.viscosity, core, core / 2, c.form, c.angle);
}

class Drop {
 public:
  Drop(const Case& c, int core, Real end) : scene_(built(scene_text(c, core, end))) {
    simulation_.begin();
  }

  /// Runs up to the first step that reaches the time t.
  void follow(Real t) {
    while (simulation_.state().time < t * (1 - 1e-12)) simulation_.advance();
    balance_ =
        std::max(balance_, std::abs(simulation_.audit().balance_error(simulation_.audit_now())));
  }
  Real value(std::string_view name) const {
    const auto found = std::find_if(scene_.measures.begin(), scene_.measures.end(),
                                    [&](const MeasureSource& m) { return m.name == name; });
    return found->compute(simulation_.state().motion());
  }
  Real radius() const { return value("wall.base_radius"); }
  Real degrees() const { return value("wall.contact_angle"); }
  Real balance() const { return balance_; }
  const Simulation<3>& simulation() const { return simulation_; }

 private:
  static Scene<3> built(const std::string& text) {
    const SceneInput input = SceneInput::from_text(text);
    scene_dimension(input);
    return build_scene<3>(input);
  }

  Scene<3> scene_;
  Simulation<3> simulation_{scene_};
  Real balance_ = 0;
};

/// Measures a spreading drop. `alone`: runs until t = 30, to measure the residual motion after t =
/// 15.
Measurement measure(const Case& c, int core, Real end, bool alone) {
  const Stopwatch set_up;
  Drop drop(c, core, alone ? 30 : end);
  Measurement m;
  m.method = c.name() + (alone ? ", left alone" : "");
  m.level = core;
  m.particles = drop.simulation().scene().system.size();
  m.h = 1 / std::cbrt(Real(m.particles));
  m.bytes = drop.simulation().scene().system.bytes();
  m.set_up = set_up.seconds();
  const Stopwatch run;
  try {
    const Curve& curve = *std::find_if(curves.begin(), curves.end(),
                                       [&](const Curve& known) { return known.angle == c.angle; });
    for (std::size_t k = 0; k < times.size() && times[k] <= end; ++k) {
      drop.follow(times[k]);
      m.errors.emplace_back(fmt::format("base radius, t = {:g}", times[k]),
                            drop.radius() / curve.radius[k] - 1);
      m.errors.emplace_back(fmt::format("angle (degrees), t = {:g}", times[k]),
                            drop.degrees() - curve.degrees[k]);
    }
    m.values = {{"angle of the cap", drop.value("wall.contact_angle_vh")}};
    if (alone) {
      drop.follow(15);
      const Real radius = drop.radius(), degrees = drop.degrees();
      drop.follow(30);
      m.values.insert(m.values.end(),
                      {{"base radius, t = 30 / t = 15 - 1", drop.radius() / radius - 1},
                       {"angle, t = 30 - t = 15", drop.degrees() - degrees},
                       {"Ca, t = 30", drop.value("drop.ca")},
                       {"least area ratio", drop.value("drop.least_area_ratio")}});
    }
  } catch (const SolveError& e) {
    m.remark = e.what();
  }
  m.time = run.seconds();
  m.values.emplace_back("energy balance", drop.balance());
  m.values.emplace_back("steps", Real(drop.simulation().state().step));
  return m;
}

/// Requirements for 997 to 4341 particles. Finer drops are more accurate than the curves.
void check(StudyRun& study, const Measurement& m) {
  if (m.level < 6 || m.level > 10) return;
  const std::string where = fmt::format("{}, level {}: ", m.method, m.level);
  study.require(where + "went on to its end", m.remark.empty() ? 1 : 0, {1, 1});
  for (const auto& [what, error] : m.errors)
    if (what != "angle (degrees), t = 1")  // the drop is not a cap yet
      study.require(where + what, error,
                    what.starts_with("angle") ? Range{-1.5, 1.5} : Range{-0.02, 0.02});
  const auto value = [&](const std::string& name) {
    for (const auto& [what, number] : m.values)
      if (what == name) return number;
    return Real{0};
  };
  study.require(where + "energy balance", value("energy balance"), {0, 1e-3});
  if (m.method.ends_with("left alone"))
    study.require(where + "Ca, t = 30", value("Ca, t = 30"), {0, 1e-4});
}

void run(StudyRun& study) {
  study.finish_settings();
  const Real end = study.brief() ? 2 : 6;
  const auto add = [&](const Case& c, int level, bool alone) {
    study.record(measure(c, level, end, alone));
    if (std::string_view(c.form) == "balanced") check(study, study.measurements().back());
  };
  for (const int level : study.levels()) add({90, "balanced", "implicit"}, level, false);
  if (study.brief()) return;
  for (const int angle : {60, 120})
    for (const int level : study.levels())
      if (level >= 6 && level <= 10) add({angle, "balanced", "implicit"}, level, false);
  // The drop of 90 degrees with the weak form and with explicit viscosity; the drop of 120 degrees
  // left alone.
  add({90, "weak", "implicit"}, 6, false);
  add({90, "balanced", "explicit"}, 6, false);
  for (const char* form : {"balanced", "weak"}) add({120, form, "implicit"}, 6, true);
}

const bool registered =
    register_entry(StudyEntry{"wetting",
                              "a drop that spreads on a wall: base radius, contact angle, rest",
                              "cells per edge of the core of the ball",
                              {4, 6, 8, 10, 14},
                              {4, 6},
                              run});

}  // namespace
}  // namespace meniscus::wetting_study
