// SPDX-License-Identifier: BSD-3-Clause
// A red blood cell by deflation to 0.7 of its cavity: error against axisymmetric finite elements
// (red blood cell note 4) over time to solution, and what happens to shells that are not perfect.
#include "meniscus/scene/simulation.hpp"
#include "meniscus/study/study.hpp"

#include <fmt/format.h>

#include <cmath>

namespace meniscus {
namespace {

constexpr Real quarter_meridian = 5.8561945;  // 3.5 + 1.5 pi/2

/// A shell and how it is deflated. `keys`: further keys of the body, `tables`: of the scene.
struct Variation {
  std::string name;
  int layers = 4;
  Real thickness = 0.5, bulk_modulus = 1e5;
  Real target = 0.69863, penalty = 2e4;  // 0.7 V0 at the pressure of the finite elements
  std::string keys = {}, tables = {};
};

std::string scene_text(const Variation& v, int cells) {
  return fmt::format(R"toml(
dimension = 3
units.system = "um-us-fg"
time = {{ end = 100, solver = "relax" }}
[[body]]
name = "cell"
shape = "disk_shell"
radius = 5
height = 3
thickness = {}
layers = {}
spacing = {:.9g}
{}
[body.material]
type = "liquid_crystal_elastomer"
density = 1000
mu = 1e4
bulk_modulus = {}
volume_energy = "logarithmic"
step_length = 2
[[cavity]]
body = "cell"
volume_target = {}
penalty = {}
ramp = [0, 15]
{}
)toml",
                     v.thickness, v.layers, quarter_meridian / cells * (1 + 1e-6), v.keys,
                     v.bulk_modulus, v.target, v.penalty, v.tables);
}

Real measure_of(const Scene<3>& scene, const State& state, const std::string& name) {
  for (const MeasureSource& m : scene.measures)
    if (m.name == "cell." + name) return m.compute(state.motion());
  throw std::logic_error("no measure " + name);
}

Measurement relaxed(const Variation& variation, int cells) {
  const Stopwatch set_up;
  const SceneInput input = SceneInput::from_text(scene_text(variation, cells));
  scene_dimension(input);
  Scene<3> scene = build_scene<3>(input);
  Simulation<3> simulation(scene);
  simulation.begin();

  Measurement result{.method = variation.name, .level = cells};
  result.particles = scene.system.size();
  result.h = quarter_meridian / cells;
  for (const auto& term : scene.system.terms) result.bytes += term->bytes();
  result.set_up = set_up.seconds();
  const Stopwatch run;
  while (!simulation.finished()) simulation.advance();
  result.time = run.seconds();
  const State& state = simulation.state();
  const auto measure = [&](const char* name) { return measure_of(scene, state, name); };
  result.values = {{"steps", static_cast<Real>(state.step)},
                   {"cavity fraction", measure("cavity_fraction")},
                   {"diameter", measure("diameter")},
                   {"pole thickness", measure("pole_thickness")},
                   {"largest thickness", measure("largest_thickness")},
                   {"thickness ratio", measure("thickness_ratio")},
                   {"asymmetry", measure("asymmetry")},
                   {"rim spread", measure("rim_spread")},
                   {"strain energy", simulation.audit_now().stored.at("strain")}};
  return result;
}

Real value(const Measurement& m, std::string_view name) {
  for (const auto& [key, x] : m.values)
    if (key == name) return x;
  throw std::logic_error("no value");
}

/// Relative errors against the finite-element shell at 0.7 V0.
Measurement compared(Measurement m) {
  const auto error = [&](std::string_view name, Real exact) {
    return std::abs(value(m, name) / exact - 1);
  };
  m.errors = {{"thickness ratio", error("thickness ratio", 0.602306)},
              {"pole thickness", error("pole thickness", 1.61075)},
              {"largest thickness", error("largest thickness", 2.67431)},
              {"diameter", error("diameter", 10.11076)},
              {"strain energy", error("strain energy", 490.546)}};
  return m;
}

void converge(StudyRun& study) {
  std::vector<Variation> methods{{.name = "4 layers"}};
  if (!study.brief()) {
    methods.push_back({.name = "3 layers", .layers = 3});
    methods.push_back({.name = "6 layers", .layers = 6});
    methods.push_back(
        {.name = "4 layers, gauss 2", .keys = "integration = \"gauss\"\ngauss_points = 2"});
  }
  for (const Variation& method : methods)
    for (const int cells : study.levels()) study.record(compared(relaxed(method, cells)));
  for (const int cells : study.levels()) {
    const Measurement* m = study.find("4 layers", cells);
    if (cells < 12 || m == nullptr) continue;
    study.require(fmt::format("diameter, 4 layers, {} cells", cells), m->error("diameter"),
                  {0, 0.01});
    study.require(fmt::format("largest thickness, 4 layers, {} cells", cells),
                  m->error("largest thickness"), {0, 0.02});
    study.require(fmt::format("pole thickness, 4 layers, {} cells", cells),
                  m->error("pole thickness"), {0, 0.03});
    study.require(fmt::format("energy, 4 layers, {} cells", cells), m->error("strain energy"),
                  {0, 0.05});
  }
}

/// Shells that are thinner, thicker, stiffer, not perfect, or pushed: all end biconcave.
void vary(StudyRun& study, int cells) {
  // A force on the faces towards -z in the middle of the ramp: 20 Pa on a wall of 0.5 um.
  const std::string push = R"toml([[body_force]]
body = "cell"
acceleration = ["0", "0", "-0.04*exp(-(x^2+y^2)/8)*exp(-((t-7)/3)^2)"]
)toml";
  const std::vector<Variation> variations{
      {.name = "thickness 0.3", .thickness = 0.3},
      {.name = "thickness 0.7", .thickness = 0.7},
      {.name = "thickness 1.0", .thickness = 1.0},
      {.name = "K/mu = 100", .bulk_modulus = 1e6},
      {.name = "imperfect, seed 1", .keys = "imperfection = 0.1\nimperfection_seed = 1"},
      {.name = "imperfect, seed 2", .keys = "imperfection = 0.1\nimperfection_seed = 2"},
      {.name = "pushed to one side", .tables = push}};
  for (const Variation& variation : variations) {
    const Measurement m = relaxed(variation, cells);
    study.record(m);
    study.require("thickness ratio, " + variation.name, value(m, "thickness ratio"), {0.3, 0.9});
    study.require("asymmetry, " + variation.name, value(m, "asymmetry"), {0, 0.03});
    study.require("rim spread, " + variation.name, value(m, "rim spread"), {0, 0.02});
  }
}

void run(StudyRun& study) {
  study.finish_settings();
  converge(study);
  if (!study.brief()) vary(study, 12);
}

const bool registered =
    register_study({"red_blood_cell",
                    "a deflated shell against finite elements, and shells that are not perfect",
                    "cells along a quarter of the meridian",
                    {8, 12, 16, 24},
                    {8},
                    run});

}  // namespace
}  // namespace meniscus
