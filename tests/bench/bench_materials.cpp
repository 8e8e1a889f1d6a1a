// SPDX-License-Identifier: BSD-3-Clause
// Time of one evaluation at four stress points, memory to memory, including one virtual call.
#include "measure.hpp"
#include "meniscus/physics/law_registry.hpp"

#include <array>
#include <cmath>
#include <memory>

namespace meniscus::bench {
namespace {

/// Stress points come in blocks, as in the time loop: here 8 blocks of four points, at strains of a
/// few per cent.
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

/// Number of calls per time window, which is then long compared with the resolution of the clock.
constexpr int repeats = 200;

template <class Evaluate>
void run_case(benchmark::State& state, Evaluate evaluate) {
  const Points H = sample(0.05);
  Points P{};
  const double time = shortest(state, [&] {
    for (int n = 0; n < repeats; ++n) {
      for (std::size_t i = 0; i < H.size(); ++i) P[i] = evaluate(H[i], H[H.size() - 1 - i]);
      benchmark::DoNotOptimize(P.data());
      benchmark::ClobberMemory();
    }
  });
  set_columns(state, {{"ns/4 points", 1e9 * time / (repeats * static_cast<double>(H.size()))}});
}

}  // namespace

void add_material_cases() {
  for (const auto& [name, entry] : laws()) {
    const std::shared_ptr<const AnyLaw> law = entry.typical();
    add_case("stress", std::string(name), 1, [law](benchmark::State& state) {
      run_case(state, [&](const auto& H, const auto&) { return law->stress(H); });
    });
    if (!entry.viscous) continue;
    add_case("stress", std::string(name) + ", viscous part", 1, [law](benchmark::State& state) {
      run_case(state,
               [&](const auto& H, const auto& F_rate) { return law->viscous_stress(H, F_rate); });
    });
  }
}

}  // namespace meniscus::bench
