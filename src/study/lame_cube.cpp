// SPDX-License-Identifier: BSD-3-Clause
// State error against time to solution: the free cube in its Lame mode, an exact solution of linear
// elastodynamics (performance note 3). Amplitude 1e-5: the neo-Hookean law is linear to 1e-5.
#include "meniscus/scene/simulation.hpp"
#include "meniscus/study/study.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <numbers>

namespace meniscus::lame_cube_study {
namespace {

constexpr Real young = 1, poisson = 0.3, amplitude = 1e-5;
constexpr Real mu = young / (2 * (1 + poisson));
constexpr Real lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
const Real omega = std::numbers::pi * std::sqrt(2 * mu);
const Real duration = 2 * (2 * std::numbers::pi / omega);  // two periods

/// A scene whose exact solution is u = A sin(w t) (cos pi x sin pi y, -sin pi x cos pi y, 0).
std::string scene_text(int cells, const std::string& body_keys) {
  const auto mode = [](Real size, const std::string& factor) {
    return fmt::format(
        "[\"{0:.17g}*{1}*cos(pi*x)*sin(pi*y)\", \"-{0:.17g}*{1}*sin(pi*x)*cos(pi*y)\", \"0\"]",
        size, factor);
  };
  return fmt::format(R"toml(
dimension = 3
time = {{ end = {0:.17g} }}
[[body]]
name = "cube"
shape = "box"
size = [1, 1, 1]
corner = [0, 0, 0]
cells = [{1}, {1}, {1}]
support_spacings = 2.6
initial_velocity = {2}
material = {{ type = "neo_hookean", density = 1, mu = {3:.17g}, lambda = {4:.17g} }}
{5}
[[exact]]
body = "cube"
displacement = {6}
velocity = {7}
rate = {8:.17g}
)toml",
                     duration, cells, mode(amplitude * omega, "1"), mu, lambda, body_keys,
                     mode(amplitude, fmt::format("sin({:.17g}*t)", omega)),
                     mode(amplitude * omega, fmt::format("cos({:.17g}*t)", omega)), omega);
}

/// `keys`: further keys of the body.
struct Method {
  std::string name, keys;
};

/// Processor time of all threads so far, s: on one thread what a quiet machine takes.
Real processor_time() {
  return static_cast<Real>(std::clock()) / CLOCKS_PER_SEC;
}

/// What other codes reached with one thread (performance note 3).
struct Peer {
  const char* code;
  const char* deck;
  int particles;
  Real state_error, seconds;
};
constexpr std::array<Peer, 8> peers{
    {{"LAMMPS 29 Sep 2021, MACHDYN smd/tlsph", "in.lame_smd", 4913, 0.165, 3.06},
     {"LAMMPS 29 Sep 2021, MACHDYN smd/tlsph", "in.lame_smd", 29791, 0.079, 35.5},
     {"Karamelo, TLMPM linear", "lame.mpm", 32768, 0.217, 8.7},
     {"OpenIFEM rkpm-rk4, linear basis", "of its own form", 4913, 0.061, 17.6},
     {"CalculiX 2.20, explicit C3D8", "gen_ccx.py", 15625, 0.0221, 7.7},
     {"CalculiX 2.20, explicit C3D8", "gen_ccx.py", 35937, 0.0122, 25.6},
     {"CalculiX 2.20, implicit C3D20", "gen_ccx.py", 425, 0.0069, 8.2},
     {"CalculiX 2.20, implicit C3D20", "gen_ccx.py", 1225, 0.0051, 38}}};

Measurement measure(const Method& method, int cells) {
  const Stopwatch set_up;
  const SceneInput input = SceneInput::from_text(scene_text(cells, method.keys));
  scene_dimension(input);
  Scene<3> scene = build_scene<3>(input);
  const auto state_error =
      std::find_if(scene.measures.begin(), scene.measures.end(),
                   [](const MeasureSource& m) { return m.name == "cube.state_error"; });
  Simulation<3> simulation(scene);
  simulation.begin();

  Measurement result{.method = method.name, .level = cells};
  result.particles = scene.system.size();
  result.h = 1.0 / cells;
  result.bytes = scene.system.bytes();
  result.set_up = set_up.seconds();
  const Stopwatch run;
  const Real before = processor_time();
  Real steps = 0;
  for (; simulation.state().time < scene.time.end; ++steps) simulation.advance();
  result.time = run.seconds();
  const Real processor = processor_time() - before;
  result.errors = {{"state", state_error->compute(simulation.state().motion())}};
  result.values = {{"steps", steps},
                   {"processor s", processor},
                   {"ns per particle-step", 1e9 * processor / (steps * result.particles)}};
  return result;
}

/// Says what the coarsest cube of the method with at most 1 % error took.
void compare(StudyRun& study, const std::string& method) {
  for (const Measurement& m : study.measurements()) {
    if (m.method != method || m.error("state") > 0.01) continue;
    const auto processor = std::find_if(m.values.begin(), m.values.end(), [](const auto& value) {
      return value.first == "processor s";
    });
    study.note(
        fmt::format("at most 1 % by {}: {} particles, state error {:.3g}, steps {:.3g} s of "
                    "processor time, set-up {:.3g} s",
                    method, m.particles, m.error("state"), processor->second, m.set_up));
    break;
  }
}

void run(StudyRun& study) {
  study.finish_settings();
  std::vector<Method> methods{{"q_scni", ""},
                              {"gauss 2", "integration = \"gauss\"\ngauss_points = 2"}};
  if (!study.brief()) {
    methods.push_back({"q_scni, cell_average", "volumetric = \"cell_average\""});
    methods.push_back({"gauss 3", "integration = \"gauss\"\ngauss_points = 3"});
    methods.push_back({"gauss 5", "integration = \"gauss\"\ngauss_points = 5"});
    methods.push_back({"nodal", "integration = \"nodal\""});
  }
  for (const Method& method : methods)
    for (const int cells : study.levels()) study.record(measure(method, cells));

  if (study.levels().size() > 1)
    study.require("order of the state error, q_scni", study.overall_order("q_scni", "state"),
                  {3, unbounded});
  if (const Measurement* m = study.find("q_scni", 12))
    study.require("state error of q_scni, 12 cells per edge", m->error("state"), {0, 0.01});
  for (const Method& method : methods) compare(study, method.name);
  for (const Peer& peer : peers)
    study.note(
        fmt::format("measured elsewhere, one thread: {} (deck {}), {} particles or nodes: "
                    "state error {:.3g} in {:.3g} s",
                    peer.code, peer.deck, peer.particles, peer.state_error, peer.seconds));
}

const bool registered = register_entry(
    StudyEntry{"lame_cube",
               "elastodynamics: state error of a free cube after two periods of its Lame mode",
               "cells per edge",
               {4, 6, 8, 12, 16},
               {4, 6, 8},
               run});

}  // namespace
}  // namespace meniscus::lame_cube_study
