// SPDX-License-Identifier: BSD-3-Clause
// The free cube in its Lame mode.
#include "study/support/lame_cube_case.hpp"

#include "run/simulation.hpp"
#include "study/support/pairs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <numbers>

namespace meniscus::study {
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
{5}
initial_velocity = {2}
material = {{ type = "neo_hookean", density = 1, mu = {3:.17g}, lambda = {4:.17g} }}
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

/// Processor time of all threads so far, s. On one thread this is the time of a quiet machine.
Real processor_time() {
  return static_cast<Real>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

Measurement measure_lame_cube(const std::string& method, int cells, const std::string& body_keys) {
  const Stopwatch set_up;
  const SceneInput input = SceneInput::from_text(scene_text(cells, body_keys));
  scene_dimension(input);
  Scene<3> scene = build_scene<3>(input);
  const auto state_error =
      std::find_if(scene.measures.begin(), scene.measures.end(),
                   [](const MeasureSource& m) { return m.name == "cube.state_error"; });
  Simulation<3> simulation(scene);
  simulation.begin();

  Measurement result{.method = method, .level = cells};
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
  result.values = {
      {"steps", steps},
      {"processor s", processor},
      {"ns per particle-step", 1e9 * processor / (steps * result.particles)},
      {"pairs per particle", pairs_per_particle(scene.system.terms, result.particles)}};
  return result;
}

}  // namespace meniscus::study
