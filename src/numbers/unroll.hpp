// SPDX-License-Identifier: BSD-3-Clause
// Loops that are unrolled at compile time, so that entries of index tables become fixed registers.
#pragma once
#include <cstddef>
#include <type_traits>
#include <utility>

namespace meniscus {

/// Calls f(integral_constant<size_t, k>) for k = 0, ..., N - 1.
template <std::size_t N, class F>
[[gnu::always_inline]] inline void unroll(F&& f) {
  [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
    (f(std::integral_constant<std::size_t, k>{}), ...);
  }
  (std::make_index_sequence<N>{});
}

}  // namespace meniscus
