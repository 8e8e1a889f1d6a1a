// SPDX-License-Identifier: BSD-3-Clause
// Energy of a spinning elastic disk that bounces on an adhesive plate, over the time step and the
// fineness of the contact points (CGCM note 2). The energy form is of second order in the step and
// independent of the points; the form of the dissertation has a plateau.
#include "meniscus/error.hpp"
#include "scene/scene.hpp"
#include "solve/audit.hpp"
#include "solve/step/central_difference.hpp"
#include "study/study.hpp"

#include <fmt/core.h>

namespace meniscus::contact_energy_study {
namespace {

std::string scene_text(const std::string& form, int points) {
  return fmt::format(R"toml(
dimension = 2
[time]
end = 6
[[body]]
name = "disk"
shape = "disk"
radius = 1
core = 6
rings = 3
support_spacings = 2.2
initial_velocity = ["0.5*y + 0.2*x", "-0.5*x - 0.2*y - 0.3"]
material = {{ type = "neo_hookean", density = 1, mu = 40, lambda = 30 }}
[[body_force]]
body = "disk"
acceleration = [0, -1]
[[contact]]
name = "plate"
bodies = ["disk"]
epsilon = 40
sigma0 = 0.4
beta = 1
form = "{}"
points = {}
partner = {{ type = "half_space", point = [0, -1.5], normal = [0, 1] }}
)toml",
                     form, points);
}

struct Outcome {
  Real error = 0;  ///< largest change of the balance / largest energy exchanged
  Real least_gap = unbounded;
};

Outcome bounce(Scene<2>& scene, Real step) {
  State state = scene.initial;
  start(scene.system, state);
  Audit audit;
  audit.begin(take_ledger(scene.system, state));
  Outcome outcome;
  Real largest = 0;
  while (state.time < scene.time.end) {
    advance(scene.system, state, step);
    const Ledger ledger = take_ledger(scene.system, state);
    audit.follow(scene.system, state, ledger);
    largest = std::max(largest, std::abs(ledger.balance() - audit.initial_balance));
    for (const MeasureSource& m : scene.measures)
      if (m.name == "plate.gap")
        outcome.least_gap = std::min(outcome.least_gap, m.compute(state.motion()));
  }
  outcome.error = largest / audit.energy_scale;
  return outcome;
}

Measurement measure(const std::string& form, int points, int level) {
  const SceneInput input = SceneInput::from_text(scene_text(form, points));
  scene_dimension(input);
  const Stopwatch set_up;
  Scene<2> scene = build_scene<2>(input);
  Measurement result{.method = fmt::format("{}, {} points per facet", form, points),
                     .level = level,
                     .particles = scene.system.size()};
  result.h = 0.02 / level;
  result.bytes = scene.system.bytes();
  result.set_up = set_up.seconds();
  const Stopwatch run;
  const Outcome outcome = bounce(scene, result.h);
  result.time = run.seconds();
  result.errors = {{"energy", outcome.error}};
  result.values = {{"least gap", outcome.least_gap}};
  return result;
}

void run(StudyRun& study) {
  study.finish_settings();
  const std::vector<int> fineness = study.brief() ? std::vector{2, 4} : std::vector{2, 3, 4};
  for (const std::string form : {"energy", "pressure", "dissertation"})
    for (const int points : fineness)
      for (const int level : study.levels()) study.record(measure(form, points, level));
  if (study.levels().size() < 2) return;
  const auto name_of = [](const char* form, int points) {
    return fmt::format("{}, {} points per facet", form, points);
  };
  // Errors of the energy form come from the step only. The dissertation's form keeps an error of
  // its own at the smallest step.
  const auto last_error = [&](const char* form, int points) {
    return study.find(name_of(form, points), study.levels().back())->error("energy");
  };
  study.require(
      fmt::format("energy: error with {} / with {} points", fineness.front(), fineness.back()),
      last_error("energy", fineness.front()) / last_error("energy", fineness.back()), {0.5, 2});
  study.require("dissertation: error / that of energy, at the smallest step",
                last_error("dissertation", fineness.back()) / last_error("energy", fineness.back()),
                {30, 1e6});
  for (const int points : fineness) {
    const auto name = [&](const char* form) { return name_of(form, points); };
    study.require("order in the step, " + name("energy"),
                  study.overall_order(name("energy"), "energy"), {1.7, 2.4});
    study.require("order in the step, " + name("dissertation"),
                  study.overall_order(name("dissertation"), "energy"), {-0.3, 0.5});
  }
}

const bool registered =
    register_entry(StudyEntry{"contact_energy",
                              "energy of a disk bouncing on an adhesive plate, over the "
                              "time step, for the forms of contact",
                              "steps per 0.02 time units",
                              {4, 8, 16, 32},
                              {4, 8},
                              run,
                              "time step"});

}  // namespace
}  // namespace meniscus::contact_energy_study
