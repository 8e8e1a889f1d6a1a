// SPDX-License-Identifier: BSD-3-Clause
// How speed is measured: the shortest of many short windows, one table per group of cases.
#pragma once
#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace meniscus::bench {

/// Seconds of one call.
template <class Work>
double seconds(Work&& work) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Columns of a line of the table.
using Columns = std::initializer_list<std::pair<const char*, double>>;

/// Google Benchmark keeps counters sorted by name; the number in front keeps the order given.
inline void set_columns(benchmark::State& state, Columns columns) {
  int n = 0;
  for (const auto& [name, value] : columns)
    state.counters[std::to_string(n++) + " " + name] = value;
}

/// Registers the case `group`/`name`. `run(state)` loops over the state, gives it the time of every
/// iteration and sets the columns from the shortest one: on a machine with other users, some
/// windows are undisturbed if they are short and many.
template <class Run>
benchmark::internal::Benchmark* add_case(const std::string& group, const std::string& name,
                                         int threads, Run run) {
  const auto in_threads = [threads, run](benchmark::State& state) {
    omp_set_num_threads(threads);
    run(state);
  };
  return benchmark::RegisterBenchmark((group + "/" + name).c_str(), in_threads)->UseManualTime();
}

/// Runs `work` as the loop of a case; returns the shortest time of a call.
template <class Work>
double shortest(benchmark::State& state, Work&& work) {
  double least = 1e300;
  for (auto _ : state) {
    const double time = seconds(work);
    state.SetIterationTime(time);
    least = std::min(least, time);
  }
  return least;
}

/// Runs `advance()` as the loop of a case, `part(k)` being the work of part k of it alone; returns
/// the shortest time of a step and the shares of the parts in it.
struct Shares {
  double step = 1e300;
  std::vector<double> part;  ///< in percent of the step
};
template <class Advance, class Part>
Shares shortest_step(benchmark::State& state, std::size_t parts, Advance&& advance, Part&& part) {
  Shares shares{.part = std::vector<double>(parts, 1e300)};
  for (auto _ : state) {
    const double time = seconds(advance);
    state.SetIterationTime(time);
    shares.step = std::min(shares.step, time);
    for (std::size_t k = 0; k < parts; ++k)
      shares.part[k] = std::min(shares.part[k], seconds([&] { part(k); }));
  }
  for (double& time : shares.part) time *= 100 / shares.step;
  return shares;
}

void add_material_cases();
void add_shape_function_cases();
void add_force_cases();
void add_contact_cases();
void add_memory_cases();

}  // namespace meniscus::bench
