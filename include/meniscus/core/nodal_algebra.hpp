// SPDX-License-Identifier: BSD-3-Clause
// Sums and products of nodal vectors, over all particles.
#pragma once
#include "meniscus/core/aligned.hpp"
#include "meniscus/core/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {

/// sum_A a_A . b_A
inline Real dot(const NodalVectors& a, const NodalVectors& b) {
  return parallel_sum(static_cast<Index>(a.size()), 0.0,
                      [&](Index A) { return sum(at(a, A) * at(b, A)); });
}

/// x += a w
inline void add(NodalVectors& x, Real a, const NodalVectors& w) {
  for_chunks(static_cast<Index>(x.size()), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(x, A) += a * at(w, A);
  });
}

/// The greatest length of a vector.
inline Real largest(const NodalVectors& w) {
  Real square = 0;
  for (const NodalVector& x : w) square = std::max(square, sum(x * x));
  return std::sqrt(square);
}

}  // namespace meniscus
