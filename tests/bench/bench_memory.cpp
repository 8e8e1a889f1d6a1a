// SPDX-License-Identifier: BSD-3-Clause
// Bandwidth of loops that only read memory: the bound for steps of large bodies.
#include "measure.hpp"
#include "parallel/aligned.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

namespace meniscus::bench {
namespace {

/// Size of the array: far more than the caches hold.
constexpr std::size_t numbers = std::size_t{1} << 27;

/// Sum of an array. Cache lines are prefetched as in the loops over rows.
Real sum_of(const Real* p, const Real* end) {
  constexpr std::ptrdiff_t line = 8, ahead = 512;
  Lanes even = Lanes::zero(), odd = even;
  for (; p != end; p += line) {
    prefetch(p + ahead);
    even += Lanes::load(p);
    odd += Lanes::load(p + line / 2);
  }
  return sum(even + odd);
}

void add_reading_case(int threads) {
  add_case("memory", fmt::format("reading, {} thread{}", threads, threads > 1 ? "s" : ""), threads,
           [](benchmark::State& state) {
             const AlignedVector<Real> read(numbers, 1.0);
             const auto part = [&](int c) {
               return read.data() + numbers / 64 * static_cast<std::size_t>(c);
             };
             const double time = shortest(state, [&] {
               Real total = 0;
#pragma omp parallel for reduction(+ : total) schedule(static)
               for (int c = 0; c < 64; ++c) total += sum_of(part(c), part(c + 1));
               benchmark::DoNotOptimize(total);
             });
             set_columns(state, {{"GB/s", 1e-9 * sizeof(Real) * numbers / time}});
           });
}

}  // namespace

void add_memory_cases() {
  for (const int threads : {1, 2}) add_reading_case(threads);
}

}  // namespace meniscus::bench
