// SPDX-License-Identifier: BSD-3-Clause
// A drop at rest, without any disturbance.
#include "study/support/static_drop_case.hpp"

#include "kernel/row_sums.hpp"
#include "measure/drop_measures.hpp"
#include "run/simulation.hpp"
#include "study/support/pairs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus::study {
namespace {

// R = rho = gamma = 1. K (1 - J) = D - 1 is the Laplace pressure. The reference is larger by
// J^(-1/D), so that the ball starts with R = 1.
std::string scene_text(const StaticDrop& c, int core, Real end) {
  constexpr Real bulk_modulus = 173;
  const Real J = 1 - (c.D - 1) / bulk_modulus, stretch = std::pow(J, 1.0 / c.D);
  const Real ratio = c.stretched ? 1.5 : 1, a = std::pow(ratio, -1.0 / c.D) / stretch;
  const std::string axes = c.D == 3 ? fmt::format("[{0:.17g}, {1:.17g}, {0:.17g}]", a, ratio * a)
                                    : fmt::format("[{:.17g}, {:.17g}]", a, ratio * a);
  const std::string u = fmt::format("{:.17g}", stretch - 1);
  return fmt::format(R"toml(
dimension = {0}
time = {{ end = {1:.17g} }}
[[body]]
name = "drop"
shape = "{2}"
semi_axes = {3}
core = {4}
{5} = {6}
{13}
initial_displacement = ["{7}*x", "{7}*y"{8}]
[body.material]
type = "newtonian"
density = {9:.17g}
bulk_modulus = {10}
equation_of_state = "linear"
viscosity = {11:.17g}
[[surface_tension]]
body = "drop"
gamma = 1
form = "{12}"
)toml",
                     c.D, end, c.D == 3 ? "ellipsoid" : "ellipse", axes, core,
                     c.D == 3 ? "layers" : "rings", std::max(1, core / 2), u,
                     c.D == 3 ? ", \"" + u + "*z\"" : "", J, bulk_modulus, c.Oh, c.form,
                     c.body_keys);
}

template <int D>
Measurement measure(const StaticDrop& c, int level, Real end) {
  const Stopwatch set_up;
  const SceneInput input = SceneInput::from_text(scene_text(c, D == 3 ? level : 2 * level, end));
  scene_dimension(input);
  Scene<D> scene = build_scene<D>(input);
  Simulation<D> simulation(scene);
  simulation.begin();
  const State& state = simulation.state();
  const auto value = [&](const std::string& name) {
    const auto found = std::find_if(scene.measures.begin(), scene.measures.end(),
                                    [&](const auto& m) { return m.name == "drop." + name; });
    return found->compute(state.motion());
  };

  Measurement m;
  m.method = c.name();
  m.level = level;
  m.particles = scene.system.size();
  m.h = std::pow(Real(m.particles), -1.0 / D);
  m.bytes = scene.system.bytes();
  m.set_up = set_up.seconds();
  if (!c.stretched)
    m.errors.emplace_back("residual force",
                          capillary_residual(state.force, 1, value("area"), value("volume"), D));
  const Stopwatch run;
  Real balance = 0;
  try {
    for (int tenth = 1; tenth <= 10; ++tenth) {
      while (state.time < end * tenth / 10 - 1e-12 * end) simulation.advance();
      balance =
          std::max(balance, std::abs(simulation.audit().balance_error(simulation.audit_now())));
    }
  } catch (const SolveError& e) {
    m.remark = e.what();
  }
  m.time = run.seconds();
  m.errors.insert(m.errors.end(), {{"Ca", value("ca")},
                                   {"isoperimetric - 1", value("isoperimetric") - 1},
                                   {"roughness", value("roughness")}});
  Real fastest = 0;
  const Body<D>& body = scene.system.bodies.front();
  for (Index A = 0; A < body.size(); ++A) {
    const Lanes v = value_at(body.at_particles, A, state.v.data());
    fastest = std::max(fastest, std::sqrt(sum(v * v)));
  }
  m.values = {{"pairs per particle", pairs_per_particle(scene.system.terms, m.particles)},
              {"max speed (D rho/gamma)^(1/2)", fastest * std::sqrt(2.0)},
              {"aspect - 1", value("aspect") - 1},
              {"least area ratio", value("least_area_ratio")},
              {"energy balance", balance},
              {"end", state.time},
              {"steps", Real(state.step)}};
  return m;
}

}  // namespace

std::string StaticDrop::name() const {
  return fmt::format("{}D {}, Oh = {:g}, {}", D,
                     stretched ? (D == 3 ? "ellipsoid" : "ellipse") : (D == 3 ? "ball" : "disk"),
                     Oh, form);
}

Real round_time(const StaticDrop& c) {
  const Real lamb = (c.D == 3 ? 5 : 4) * c.Oh, creeping = (c.D == 3 ? 20.0 / 19 : 1) / c.Oh;
  return std::max(10.0, 5.5 / std::min(lamb, creeping));
}

Measurement measure_static_drop(const StaticDrop& c, int level, Real end) {
  return c.D == 3 ? measure<3>(c, level, end) : measure<2>(c, level, end);
}

}  // namespace meniscus::study
