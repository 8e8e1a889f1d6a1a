// SPDX-License-Identifier: BSD-3-Clause
// Time of the force terms, of a whole step, and of the set-up, on the ball of 4341 particles.
#include "measure.hpp"
#include "scene/scene.hpp"
#include "solve/step/central_difference.hpp"

#include <fmt/core.h>

#include <memory>

namespace meniscus::bench {
namespace {

constexpr const char* neo_hookean = "type = 'neo_hookean'\ndensity = 1\nmu = 1\nlambda = 2";
constexpr const char* newtonian =
    "type = 'newtonian'\ndensity = 1\nbulk_modulus = 10\nviscosity = 0.1\n"
    "equation_of_state = 'linear'";

/// A ball in smooth motion. `body` and `more` are further lines of its table and of the scene.
SceneInput ball(const std::string& material, const std::string& body, const std::string& more) {
  return SceneInput::from_text(fmt::format(R"toml(
dimension = 3
time.end = 1
[[body]]
name = "ball"
shape = "ball"
radius = 1
core = 10
layers = 5
initial_displacement = ["0.01*sin(3*y)", "0.01*sin(3*z)", "0.01*sin(3*x)"]
initial_velocity = ["0.01*cos(3*y)", "0.01*cos(3*z)", "0.01*cos(3*x)"]
{}
[body.material]
{}
{}
)toml",
                                           body, material, more));
}

std::string tension(const std::string& form) {
  return fmt::format("[[surface_tension]]\nbody = 'ball'\ngamma = 1\nform = '{}'", form);
}

/// The scene of a case, kept if the next case has the same input.
Scene<3>& scene_of(const std::string& material, const std::string& body, const std::string& more) {
  static std::string built;
  static std::unique_ptr<Scene<3>> scene;
  if (const std::string key = material + "\n" + body + "\n" + more; key != built) {
    scene.reset();
    const int threads = omp_get_max_threads();
    omp_set_num_threads(omp_get_num_procs());
    const SceneInput input = ball(material, body, more);
    scene_dimension(input);  // all keys have to be read
    scene = std::make_unique<Scene<3>>(build_scene<3>(input));
    start(scene->system, scene->initial);
    omp_set_num_threads(threads);
    built = key;
  }
  return *scene;
}

/// Measures term number `term` of the scene.
void add_term_case(const std::string& group, const std::string& name, std::size_t term,
                   const std::string& material, const std::string& body, const std::string& more) {
  for (const int threads : {1, 2})
    add_case(group, fmt::format("{}, {} thread{}", name, threads, threads > 1 ? "s" : ""), threads,
             [=](benchmark::State& state) {
               const Scene<3>& scene = scene_of(material, body, more);
               ForceTerm& force = *scene.system.terms.at(term);
               NodalVectors sum = scene.initial.force;
               const double time =
                   shortest(state, [&] { force.add_force(scene.initial.motion(), sum); });
               const double particles = scene.system.size();
               const double pairs = static_cast<double>(force.pairs());
               set_columns(state,
                           {{"ns/particle", 1e9 * time / particles},
                            {"ns/pair", 1e9 * time / pairs},
                            {"pairs/particle", pairs / particles},
                            {"bytes/particle", static_cast<double>(force.bytes()) / particles}});
             });
}

/// A step of the relaxing drop and the shares of its parts, in percent of the shortest step.
void add_step_case(int threads) {
  add_case("step of a drop", fmt::format("q_scni, weak tension, {} threads", threads), threads,
           [](benchmark::State& state) {
             Scene<3>& scene = scene_of(newtonian, "", tension("weak"));
             State moving = scene.initial;
             NodalVectors sum = moving.force;
             const Shares shares = shortest_step(
                 state, scene.system.terms.size(), [&] { advance(scene.system, moving, 1e-9); },
                 [&](std::size_t k) { scene.system.terms[k]->add_force(moving.motion(), sum); });
             set_columns(state, {{"ns/particle-step", 1e9 * shares.step / scene.system.size()},
                                 {"% internal", shares.part[0]},
                                 {"% tension", shares.part[1]},
                                 {"% rest", 100 - shares.part[0] - shares.part[1]}});
           });
}

void add_setup_case(int threads) {
  add_case("set-up", fmt::format("q_scni, default support, {} threads", threads), threads,
           [](benchmark::State& state) {
             const Body<3>& body = scene_of(newtonian, "", tension("weak")).system.bodies.front();
             const double time = shortest(
                 state, [&] { benchmark::DoNotOptimize(build_cell_rule(body).rule.pairs()); });
             set_columns(state, {{"us/particle", 1e6 * time / body.size()}});
           })
      ->Iterations(2);
}

}  // namespace

void add_force_cases() {
  for (const char* form : {"weak", "curvature", "triangles"})
    add_term_case("surface tension", form, 1, neo_hookean, "integration = 'nodal'", tension(form));
  const std::string hundred_pairs = "support_factor = 1.36";
  const std::string group = "internal force";
  add_term_case(group, "q_scni, neo_hookean", 0, neo_hookean, hundred_pairs, "");
  add_term_case(group, "q_scni, newtonian", 0, newtonian, hundred_pairs, "");
  add_term_case(group, "q_scni, neo_hookean, default support", 0, neo_hookean, "", "");
  add_term_case(group, "gauss 2, neo_hookean, default support", 0, neo_hookean,
                "integration = 'gauss'\ngauss_points = 2", "");
  add_term_case(group, "nodal, neo_hookean, default support", 0, neo_hookean,
                "integration = 'nodal'", "");
  add_term_case(group, "q_scni, newtonian, default support", 0, newtonian, "", tension("weak"));
  for (const int threads : {1, 2}) add_step_case(threads);
  for (const int threads : {1, 2}) add_setup_case(threads);
}

}  // namespace meniscus::bench
