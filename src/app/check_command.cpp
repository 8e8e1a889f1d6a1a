// SPDX-License-Identifier: BSD-3-Clause
// Dry run of a scene: builds everything that a run needs, but makes no run.
#include "app/advice.hpp"
#include "app/commands.hpp"
#include "app/mesh_report.hpp"
#include "app/outputs.hpp"
#include "app/print.hpp"
#include "app/restart.hpp"
#include "app/set_up.hpp"
#include "app/stages.hpp"
#include "body/surface/face_cells.hpp"
#include "numbers/box.hpp"
#include "numbers/dense.hpp"
#include "run/initial_state.hpp"
#include "run/simulation.hpp"
#include "scene/half_plane_twin.hpp"
#include "solve/expected_effort.hpp"
#include "solve/step/pseudo_time.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

namespace meniscus {
namespace {

template <int D>
bool flows(const Scene<D>& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const SceneBody& body) { return body.is_fluid(); });
}

/// Expected cost of an equilibrium with `newton` and with `relax`. Empty if no estimate is
/// possible.
template <int D>
std::optional<ExpectedEffort> effort_to_rest(Scene<D>& scene, const State& state, Real dt,
                                             bool thin) {
  constexpr Real usual_steps = 20;
  std::vector<bool> fluid;
  for (const SceneBody& body : scene.bodies) fluid.push_back(body.is_fluid());
  const Real steady = scene.system.steady_after(), end = scene.time.end;
  const Real duration = steady > 0 ? std::min(steady, end) : end;
  const Real steps = steady == 0 ? !flows(scene)
                     : scene.time.solver == "newton" && scene.time.step
                         ? duration / *scene.time.step
                         : usual_steps;
  return expected_effort(scene.system, state, std::ceil(steps - 1e-9), std::min(steady, end), dt,
                         fluid, {scene.time.force_tolerance, scene.time.shape_tolerance},
                         thin ? PseudoTime<D>::least_steps : Relaxation<D>::least_steps);
}

/// "about 500", or "150 to 3000".
std::string rounded_steps(const ExpectedEffort& effort) {
  constexpr Real narrow = 2;
  const Real steps = effort.relaxation_steps;
  if (effort.uncertainty <= narrow) return fmt::format("about {:.0f}", steps);
  return fmt::format("{:.0f} to {:.0f}", steps / effort.uncertainty, steps * effort.uncertainty);
}

/// Prints the expected cost of `newton` and of `relax`, which one is faster, and by which factor.
void say_effort(const ExpectedEffort& effort, bool flows) {
  say("newton: {:.0f} {} of about {:.0f} {} at {:.2g} s, expected {:.2g} s; relax: {} steps "
      "at {:.2g} s, expected {:.2g} s\n",
      effort.load_steps, flows ? "steps of implicit Euler" : "load steps", effort.tangents_per_step,
      effort.by_factors ? "factors of the tangent" : "tangents", effort.seconds_per_tangent,
      effort.newton_seconds(), rounded_steps(effort), effort.seconds_per_step,
      effort.relaxation_seconds());
  const Real ratio = effort.relaxation_seconds() / effort.newton_seconds();
  say("{} is expected to be {:.1f} times as fast, within a factor of {:g}\n",
      ratio > 1 ? "newton" : "relax", std::max(ratio, 1 / ratio), 1.5 * effort.uncertainty);
}

/// Warns that the stable step, which is computed for the initial shape of the bodies, may shrink
/// while loads or motions deform them.
template <int D>
void say_what_shortens_steps(const Scene<D>& scene) {
  const Real steady = scene.system.steady_after();
  if (steady == 0) return;
  const std::string until =
      steady < scene.time.end ? fmt::format("until t = {:.6g}", steady) : "until the end";
  say("loads or motions change {}: steps become shorter where they stretch or press bodies, the "
      "more the farther, so that there may be many more steps than the start lets expect\n",
      until);
}

/// Prints where a body is, its supports and its faces.
template <int D>
void say_body(const Body<D>& body, const std::string& length) {
  const Box<D> box = box_around<D>(body.particles.X());
  Real least = unbounded, largest = 0;
  for (Index A = 0; A < body.size(); ++A) {
    least = std::min(least, at(body.particles.support(), A));
    largest = std::max(largest, at(body.particles.support(), A));
  }
  std::string ranges;
  for (int i = 0; i < D; ++i)
    ranges += fmt::format("{}[{:.4g}, {:.4g}]", i ? " x " : "", box.low[i], box.high[i]);
  std::string stretched;
  if (const Mat<D>* pressed = body.particles.pressed()) {
    const Vec<D> shares = symmetric_eigenvalues<D>(*pressed);
    stretched = fmt::format(", stretched by {:.4g} to {:.4g} as its cells", 1 / shares[D - 1],
                            1 / shares[0]);
  }
  say("body '{}': occupies {} {}, supports {:.4g} to {:.4g} {}{}\n", body.name, ranges, length,
      least, largest, length, stretched);
  std::string faces;
  for (const auto& [name, facets] : face_names(body.geometry))
    faces += fmt::format("{}{} ({} facets)", faces.empty() ? "" : ", ", name, facets);
  if (!faces.empty()) say("body '{}': faces {}\n", body.name, faces);
  constexpr Real least_drawn = 1e-6;
  if (box.extent().maxCoeff() < least_drawn)
    say("body '{}': viewers that compute in single precision, ParaView among them, draw lengths "
        "below "
        "{:g} black; other units show it, such as [units] system = \"nm-ps-ag\"\n",
        body.name, least_drawn);
}

/// Prints the stable step of motion beside the load steps of `newton`.
template <int D>
void say_load_steps(Scene<D>& scene, const State& state) {
  const StableStep stable = StableStepEstimator<D>(scene.system).estimate(state);
  say("stable step of motion {:.6g} {}; newton: load steps of {:.6g}\n", stable.dt,
      scene.units.symbol(dimension::time), scene.time.step.value_or(scene.time.end / 20));
  if (const auto effort = effort_to_rest(scene, state, scene.time.safety * stable.dt, false))
    say_effort(*effort, flows(scene));
}

/// Prints the stable step and its causes, and the step `dt` in use.
template <int D>
void say_step(const Scene<D>& scene, const StableStep& stable, Real dt, bool thin) {
  say("stable step {:.6g} {} (", stable.dt, scene.units.symbol(dimension::time));
  if (stable.viscosity > 0)
    say("stiffness alone {:.3g}, viscosity alone {:.3g}; ", 2 / stable.stiffness,
        2 / stable.viscosity);
  say("used{}: {:.6g})\n", thin ? " with the inertia of thin bodies in relaxation" : "", dt);
  constexpr Real worth_it = 2;
  if (const Real ratio = 2 / (stable.stiffness * stable.dt);
      stable.viscosity > 0 && scene.time.solver == "dynamics" &&
      scene.time.viscosity == "explicit" && ratio > worth_it)
    say("viscosity limits the step: time.viscosity = \"implicit\" allows up to {:.1f} times as "
        "long "
        "ones, for a few iterations per step\n",
        ratio);
}

/// Makes a few steps; returns the median of their seconds. The first steps include a search for the
/// stable step, which later steps rarely repeat.
template <int D>
double seconds_per_step(Simulation<D>& simulation) {
  constexpr std::size_t trial_steps = 10;
  std::vector<double> seconds;
  while (seconds.size() < trial_steps && !simulation.finished()) {
    const auto begin = std::chrono::steady_clock::now();
    simulation.advance();
    seconds.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds.empty() ? 0 : seconds[seconds.size() / 2];
}

/// Prints how many steps the run takes, and how long. `steps`: those to the end of the scene.
template <int D>
void say_length(const Scene<D>& scene, const std::optional<ExpectedEffort>& effort, Real steps,
                double per_step) {
  const bool changing = scene.system.steady_after() > 0 && !scene.time.step;
  std::string until = changing ? " if they stay as long as at the start" : "";
  if (effort) {
    say_effort(*effort, flows(scene));
    const bool rests = effort->relaxation_steps < steps;
    until = rests ? " to rest" : " to time.end, too few to come to rest";
    if (rests) steps = std::round(effort->relaxation_steps);
    if (rests && effort->uncertainty > 2)
      until += fmt::format(", or {} times more or fewer", effort->uncertainty);
  } else if (scene.time.solver == "relax") {
    until = " to time.end" + until + ", fewer if it comes to rest before";
  }
  say("{} steps{}, about {:.3g} s on {} threads ({:.0f} ns per particle-step), {:.1f} MB for "
      "forces\n",
      steps < 1e9 ? fmt::format("{:.0f}", steps) : fmt::format("{:.3g}", steps), until,
      steps * per_step, omp_get_max_threads(), 1e9 * per_step / scene.system.size(),
      1e-6 * static_cast<Real>(scene.system.bytes()));
  say_what_shortens_steps(scene);
}

/// Prints the step and the length of a run that makes steps of motion.
template <int D>
void check_steps(Scene<D>& scene, Simulation<D>& simulation, const SceneInput& input,
                 const RunRequest& request) {
  const bool thin = simulation.stepper().chooses_step();
  const StableStep stable = thin ? StableStepEstimator<D>(scene.system).estimate(simulation.state())
                                 : simulation.controller().stable();
  const Real dt = thin ? ElasticStep<D>(scene.system, scene.time.safety)
                             .at_state(ElasticInertia<D>(scene.system), simulation.state())
                       : scene.time.step.value_or(scene.time.safety * stable.dt);
  say_step(scene, stable, dt, thin);
  std::optional<ExpectedEffort> effort;
  if (scene.time.solver == "relax") effort = effort_to_rest(scene, simulation.state(), dt, thin);
  double per_step = 0;
  set_up(input, [&] { per_step = seconds_per_step(simulation); });
  if (effort) effort->seconds_per_step = per_step;
  const Real stop = time_to_stop(request, scene.units);
  say_length(scene, effort, std::ceil(std::min(scene.time.end, stop) / dt), per_step);
  if (!scene.time.step) say_softer_drops(scene, request, stable.dt);
}

/// Builds the scene in its first state. The stage before may not have run yet: then its bodies are
/// as they begin in the first stage.
template <int D>
Scene<D> built_scene(const SceneInput& input, const RunRequest& request) {
  const Plan<D> plan = read_plan<D>(input);
  if (!request.stage || request.stage->from.empty() || has_checkpoint(request.stage->from))
    return build_from(plan, read_initial_state(plan));
  Scene<D> scene = build(plan);
  scene.notes.push_back(
      "the first state is the last of the stage before, which has not run: what is said about it "
      "is for bodies as they begin");
  return scene;
}

/// Says that a 3D scene is of revolution.
template <int D>
void say_twin(const SceneInput& input, const Scene<D>& scene) {
  if constexpr (D == 3) {
    try {
      const HalfPlaneTwin twin = half_plane_twin(input, read_plan<3>(input));
      say("the scene is of revolution: `meniscus revolve` writes it for the half plane, with {} "
          "particles instead of {}\n",
          twin.particles, scene.system.size());
    } catch (const InputError&) {
      return;  // it is not
    }
  }
}

template <int D>
void check_scene(const SceneInput& input, const RunRequest& request) {
  Scene<D> scene = set_up(input, [&] { return built_scene<D>(input, request); });
  require_known_outputs(input, scene);
  time_to_stop(request, scene.units);  // throws if it is wrong
  if (!scene.title.empty()) say("{}\n", scene.title);
  for (const auto& note : scene.notes) say("{}\n", note);
  for (const Body<D>& body : scene.system.bodies)
    say_body(body, scene.units.symbol(dimension::length));
  say_meshes(scene, input);
  say_units(scene.units);
  say_drop_numbers(scene, input);
  for (const auto& term : scene.system.terms)
    say("{}: {} pairs, {:.1f} MB\n", term->name(), term->pairs(),
        1e-6 * static_cast<Real>(term->bytes()));

  Simulation<D> simulation = set_up(input, [&] { return Simulation<D>(scene); });
  set_up(input, [&] { simulation.begin(); });
  for (const std::string& note : simulation.take_notes()) say("{}\n", note);
  warn_of_idle_contacts(scene, simulation.state());
  if (scene.time.solver == "newton")
    say_load_steps(scene, simulation.state());
  else
    check_steps(scene, simulation, input, request);
  if (!request.stage) say_twin(input, scene);
  for (const auto& warning : scene.warnings) say("warning: {}\n", warning);
  say("the scene is in order\n");
}

}  // namespace

void check(const RunRequest& request) {
  if (request.threads > 0) omp_set_num_threads(request.threads);
  const auto check_one = [](const SceneInput& input, const RunRequest& one) {
    scene_dimension(input) == 2 ? check_scene<2>(input, one) : check_scene<3>(input, one);
  };
  const SceneInput whole = SceneInput::from_file(request.scene, request.set);
  const std::vector<std::string> stages = whole.stages();
  if (stages.empty()) return check_one(whole, request);
  for (std::size_t k = 0; k < stages.size(); ++k) {
    say("{}stage {} of {}: {}\n", k > 0 ? "\n" : "", k + 1, stages.size(), stages[k]);
    const RunRequest one = request_of_stage(request, stages, k, output_directory(request));
    check_one(SceneInput::from_file(one.scene, one.set, one.stage), one);
  }
}

}  // namespace meniscus
