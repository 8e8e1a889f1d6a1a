// SPDX-License-Identifier: BSD-3-Clause
// Loops over threads whose results do not depend on the number of threads.
#pragma once
#include "meniscus/core/types.hpp"

#include <algorithm>
#include <array>
#include <exception>

namespace meniscus {

/// Number of row chunks of every force sum. Fixed, never the thread count: it decides the order of
/// summation, and so the last bits of every result.
inline constexpr int chunk_count = 16;

/// Row number at which chunk c of n rows begins.
inline Index chunk_begin(Index n, int c) {
  return static_cast<Index>(static_cast<Offset>(n) * c / chunk_count);
}

/// Calls f(i) for i in [0, n) on all threads, `grain` neighbouring i at a time. The first exception
/// is rethrown afterwards (one that leaves an OpenMP region would end the program).
template <class F>
void parallel_for(Index n, F&& f, [[maybe_unused]] int grain = 64) {
  std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic, grain)
  for (Index i = 0; i < n; ++i) {
    try {
      f(i);
    } catch (...) {
#pragma omp critical(meniscus_parallel_for)
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

/// Calls f(chunk, begin, end) for the fixed chunks of n rows on all threads.
template <class F>
void for_chunks(Index n, F&& f) {
  parallel_for(
      chunk_count, [&](Index c) { f(c, chunk_begin(n, c), chunk_begin(n, c + 1)); }, 1);
}

/// Sum of f(i) over [0, n), added in the order of the fixed chunks.
template <class T, class F>
T parallel_sum(Index n, T zero, F&& f) {
  std::array<T, chunk_count> partial;
  partial.fill(zero);
  for_chunks(n, [&](Index c, Index begin, Index end) {
    T s = zero;
    for (Index i = begin; i < end; ++i) s = s + f(i);
    at(partial, c) = s;
  });
  T total = zero;
  for (const T& p : partial) total = total + p;
  return total;
}

}  // namespace meniscus
