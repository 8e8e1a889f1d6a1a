// SPDX-License-Identifier: BSD-3-Clause
// Time of one evaluation at four stress points, memory to memory, including one virtual call.
#include "meniscus/physics/law_registry.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <memory>

namespace meniscus {
namespace {

/// Stress points of the time loop come in blocks; here of 8 x 4, at strains of a few per cent.
using Points = std::array<Tensor<Lanes>, 8>;

Points sample(Real size) {
  Points points;
  int n = 0;
  for (Tensor<Lanes>& point : points)
    for (int k = 0; k < 9; ++k)
      for (int lane = 0; lane < Lanes::width; ++lane)
        point(k / 3, k % 3).set(lane, size * std::sin(Real(++n)));
  return points;
}

template <class Evaluate>
void measure(benchmark::State& state, Evaluate evaluate) {
  Points H = sample(0.05), P{};
  for (auto _ : state) {
    for (std::size_t i = 0; i < H.size(); ++i) P[i] = evaluate(H[i], H[H.size() - 1 - i]);
    benchmark::DoNotOptimize(H.data());
    benchmark::DoNotOptimize(P.data());
    benchmark::ClobberMemory();
  }
  state.counters["per_4_points"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * static_cast<double>(H.size()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void register_benchmarks() {
  for (const auto& [name, entry] : laws()) {
    const std::shared_ptr<const AnyLaw> law = entry.typical();
    benchmark::RegisterBenchmark(("stress/" + std::string(name)).c_str(), [law](auto& state) {
      measure(state, [&](const auto& H, const auto&) { return law->stress(H); });
    });
    if (entry.viscous)
      benchmark::RegisterBenchmark(("viscous_stress/" + std::string(name)).c_str(),
                                   [law](auto& state) {
                                     measure(state, [&](const auto& H, const auto& F_rate) {
                                       return law->viscous_stress(H, F_rate);
                                     });
                                   });
  }
}

}  // namespace
}  // namespace meniscus

int main(int argc, char** argv) {
  meniscus::register_benchmarks();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
