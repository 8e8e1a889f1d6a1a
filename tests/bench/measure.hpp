// SPDX-License-Identifier: BSD-3-Clause
// Measurement of speed: the shortest of many short time windows, one table per group of cases.
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

/// Time of one call in s.
template <class Work>
double seconds(Work&& work) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Columns of a line of the table.
using Columns = std::initializer_list<std::pair<const char*, double>>;

/// Google Benchmark sorts counters by name; the number in front keeps the given order.
inline void set_columns(benchmark::State& state, Columns columns) {
  int n = 0;
  for (const auto& [name, value] : columns)
    state.counters[std::to_string(n++) + " " + name] = value;
}

/// Registers the case `group`/`name`. `run(state)` loops over the state, sets the time of each
/// iteration, and sets the columns from the shortest one. Many short windows are used, since on a
/// shared machine some of them are undisturbed.
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

/// Runs `advance()` as the loop of a case; `part(k)` does the work of part k alone. Returns the
/// shortest time of a step and the shares of the parts.
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
