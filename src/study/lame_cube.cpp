// SPDX-License-Identifier: BSD-3-Clause
// State error against time to solution: the free cube in its Lame mode, an exact solution of linear
// elastodynamics (performance note 3). Amplitude 1e-5: the neo-Hookean law is linear to 1e-5.
#include "meniscus/scene/simulation.hpp"
#include "meniscus/study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace meniscus {
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
  for (const auto& term : scene.system.terms) result.bytes += term->bytes();
  result.set_up = set_up.seconds();
  const Stopwatch run;
  Real steps = 0;
  for (; simulation.state().time < scene.time.end; ++steps) simulation.advance();
  result.time = run.seconds();
  result.errors = {{"state", state_error->compute(simulation.state().motion())}};
  result.values = {{"steps", steps},
                   {"ns per particle-step", 1e9 * result.time / (steps * result.particles)}};
  return result;
}

void run(StudyRun& study) {
  study.finish_settings();
  std::vector<Method> methods{{"q_scni", ""},
                              {"gauss 2", "integration = \"gauss\"\ngauss_points = 2"}};
  if (!study.brief()) {
    methods.push_back({"gauss 3", "integration = \"gauss\"\ngauss_points = 3"});
    methods.push_back({"nodal", "integration = \"nodal\""});
  }
  for (const Method& method : methods)
    for (const int cells : study.levels()) study.record(measure(method, cells));

  if (study.levels().size() > 1)
    study.require("order of the state error, q_scni", study.overall_order("q_scni", "state"),
                  {1.8, 1e300});
}

const bool registered =
    register_study({"lame_cube",
                    "elastodynamics: state error of a free cube after two periods of its Lame mode",
                    "cells per edge",
                    {4, 6, 8, 12, 16},
                    {4, 6, 8},
                    run});

}  // namespace
}  // namespace meniscus
