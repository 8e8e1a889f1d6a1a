// SPDX-License-Identifier: BSD-3-Clause
// Cost against size: setting up and stepping the free cube of lame_cube, per particle, with one
// thread and with two, and with two runs at the same time (performance note 6).
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"
#include "run/simulation.hpp"
#include "study/study.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <future>
#include <memory>
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

/// Sets the number of threads of all loops during its lifetime.
class Threads {
 public:
  explicit Threads(int number) : before_(omp_get_max_threads()) { omp_set_num_threads(number); }
  Threads(const Threads&) = delete;
  ~Threads() { omp_set_num_threads(before_); }

 private:
  int before_;
};

/// The free cube, ready for steps.
class Cube {
 public:
  explicit Cube(int cells) : scene_(scene_of(cells)), simulation_(scene_) { simulation_.begin(); }

  Index particles() const { return scene_.system.size(); }
  std::size_t bytes() const { return scene_.system.bytes(); }
  std::uint64_t hash() { return simulation_.snapshot().hash(); }

  /// Makes steps with `threads` threads and appends the time of each, in s.
  void make_steps(int steps, int threads, std::vector<double>& seconds) {
    const Threads number(threads);
    for (int k = 0; k < steps; ++k) {
      const Stopwatch time;
      simulation_.advance();
      seconds.push_back(time.seconds());
    }
  }

 private:
  static Scene<3> scene_of(int cells) {
    const SceneInput input = SceneInput::from_text(scene_text(cells));
    scene_dimension(input);
    return build_scene<3>(input);
  }

  Scene<3> scene_;
  Simulation<3> simulation_;
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median time per step in s: one thread, two threads, and two runs of one thread at the same time.
struct StepTimes {
  double one, two, at_once;
};

/// Measures in turns, because other programs may use the machine. Each turn takes about a second,
/// so that the threads and caches left by the previous turn do not matter. On a virtual machine, a
/// processor that slept may need up to 0.1 s until it runs near the cache of the other one again.
StepTimes step_times(Cube& cube, Cube& beside) {
  const int in_a_row = std::max(10, 2000000 / cube.particles());
  constexpr int rounds = 3;
  std::vector<double> one, two, at_once;
  for (int round = 0; round < rounds; ++round) {
    cube.make_steps(in_a_row, 1, one);
    cube.make_steps(in_a_row, 2, two);
    std::vector<double> of_beside;
    auto other = std::async(std::launch::async, [&] { beside.make_steps(in_a_row, 1, of_beside); });
    cube.make_steps(in_a_row, 1, at_once);
    other.get();
    at_once.insert(at_once.end(), of_beside.begin(), of_beside.end());
  }
  return {median(one), median(two), median(at_once)};
}

/// Sets a cube up with `threads` threads and makes its first steps.
std::unique_ptr<Cube> measure(int threads, int cells, Measurement& result) {
  const Threads number(threads);
  forget_peak_memory();
  const Stopwatch set_up;
  auto cube = std::make_unique<Cube>(cells);
  result.method = fmt::format("{} thread{}", threads, threads > 1 ? "s" : "");
  result.level = cells;
  result.set_up = set_up.seconds();
  result.particles = cube->particles();
  result.h = result.particles;
  result.bytes = cube->bytes();
  const Real n = result.particles;
  result.errors = {{"set-up, us per particle", 1e6 * result.set_up / n},
                   {"forces, kB per particle", 1e-3 * static_cast<Real>(result.bytes) / n},
                   {"peak, kB per particle", 1e-3 * peak_memory() / n}};
  std::vector<double> first;
  cube->make_steps(10, threads, first);
  return cube;
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
    Measurement one, two;
    const std::uint64_t hash = measure(1, cells, one)->hash();
    const auto cube = measure(2, cells, two);
    different += cube->hash() != hash;
    Cube beside(cells);
    const StepTimes steps = step_times(*cube, beside);
    record(study, one, steps.one);
    record(study, two, steps.two);
    study.note(fmt::format(
        "{} particles: two threads make steps {:.2f} and the set-up {:.2f} times as fast as one; "
        "two runs at once make {:.2f} times as many steps as one alone: efficiency {:.2f}",
        one.particles, steps.one / steps.two, one.set_up / two.set_up,
        2 * steps.one / steps.at_once, steps.at_once / steps.two / 2));
  }
  study.require("sizes with another state after the steps with two threads", different, {0, 0});
  // An inner particle has more neighbours than one at the surface; large bodies have a smaller
  // surface.
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
