// SPDX-License-Identifier: BSD-3-Clause
// Cost against size: building and stepping the free cube of lame_cube, per particle, with one
// thread and with two (performance note 6).
#include "meniscus/core/memory.hpp"
#include "meniscus/core/parallel.hpp"
#include "meniscus/scene/simulation.hpp"
#include "meniscus/study/study.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace meniscus::scaling_study {
namespace {

std::string scene_text(int cells) {
  return fmt::format(R"toml(
dimension = 3
time = {{ end = 1e3 }}
[[body]]
name = "cube"
shape = "box"
size = [1, 1, 1]
corner = [0, 0, 0]
cells = [{0}, {0}, {0}]
initial_velocity = ["1e-5*cos(pi*x)*sin(pi*y)", "-1e-5*sin(pi*x)*cos(pi*y)", "0"]
material = {{ type = "neo_hookean", density = 1, mu = 0.4, lambda = 0.6 }}
)toml",
                     cells);
}

/// The threads of all loops, for as long as this lives.
class Threads {
 public:
  explicit Threads(int number) : before_(omp_get_max_threads()) { omp_set_num_threads(number); }
  Threads(const Threads&) = delete;
  ~Threads() { omp_set_num_threads(before_); }

 private:
  int before_;
};

/// s per step with one thread and with two.
using StepTimes = std::array<double, 2>;

/// Of each the median over steps that are made in turns: others may use the machine.
StepTimes seconds_per_step(Simulation<3>& simulation, Index particles) {
  constexpr int in_a_row = 10;
  const int rounds = std::max(3, 100000 / particles);
  std::array<std::vector<double>, 2> times;
  for (int round = 0; round < rounds; ++round)
    for (int number = 1; number <= 2; ++number) {
      const Threads threads(number);
      for (int k = 0; k < in_a_row; ++k) {
        const Stopwatch time;
        simulation.advance();
        at(times, number - 1).push_back(time.seconds());
      }
    }
  StepTimes medians{};
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto middle = times[k].begin() + in_a_row * rounds / 2;
    std::nth_element(times[k].begin(), middle, times[k].end());
    medians[k] = *middle;
  }
  return medians;
}

struct Measured {
  Measurement result;
  StepTimes steps;
  std::uint64_t hash;
};

/// Set up with `number` threads.
Measured measure(int number, int cells) {
  const Threads threads(number);
  forget_peak_memory();
  const Stopwatch set_up;
  const SceneInput input = SceneInput::from_text(scene_text(cells));
  scene_dimension(input);
  Scene<3> scene = build_scene<3>(input);
  Simulation<3> simulation(scene);
  simulation.begin();

  Measurement result{.method = fmt::format("{} thread{}", number, number > 1 ? "s" : ""),
                     .level = cells};
  result.set_up = set_up.seconds();
  result.particles = scene.system.size();
  result.h = result.particles;
  result.bytes = scene.system.bytes();
  const Real n = result.particles;
  result.errors = {{"set-up, us per particle", 1e6 * result.set_up / n},
                   {"forces, kB per particle", 1e-3 * static_cast<Real>(result.bytes) / n},
                   {"peak, kB per particle", 1e-3 * peak_memory() / n}};
  const StepTimes steps = seconds_per_step(simulation, result.particles);
  return {std::move(result), steps, simulation.snapshot().hash()};
}

void record(StudyRun& study, Measurement result, double step) {
  result.time = step;
  result.errors.emplace_back("step, ns per particle", 1e9 * step / result.particles);
  result.values = {{"chunks", chunk_count(result.particles)},
                   {"set-up / step", result.set_up / step}};
  study.record(result);
}

void run(StudyRun& study) {
  study.finish_settings();
  int different = 0;
  for (const int cells : study.levels()) {
    const Measured one = measure(1, cells), two = measure(2, cells);
    different += one.hash != two.hash;
    const StepTimes steps{std::min(one.steps[0], two.steps[0]),
                          std::min(one.steps[1], two.steps[1])};
    record(study, one.result, steps[0]);
    record(study, two.result, steps[1]);
    study.note(fmt::format(
        "{} particles: two threads make steps {:.2f} and the set-up {:.2f} times as fast as one",
        one.result.particles, steps[0] / steps[1], one.result.set_up / two.result.set_up));
  }
  study.require("sizes with another state after the steps with two threads", different, {0, 0});
  // A particle inside has more neighbours than one at the surface, of which large bodies have less.
  if (study.levels().size() > 1)
    study.require("power of the size with which memory per particle grows",
                  study.overall_order("1 thread", "forces, kB per particle"), {-0.1, 0.1});
}

const bool registered = register_entry(
    StudyEntry{"scaling",
               "cost against size: set-up, step and memory per particle, one thread and two",
               "cells per edge of a cube",
               {9, 20, 31, 49, 62, 79},
               {9, 20},
               run,
               "particles"});

}  // namespace
}  // namespace meniscus::scaling_study
