// SPDX-License-Identifier: BSD-3-Clause
// Sums and products of nodal vectors, over all particles.
#pragma once
#include "parallel/aligned.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace meniscus {

/// sum_A a_A . b_A
inline Real dot(const NodalVectors& a, const NodalVectors& b) {
  return parallel_sum<Cost::little>(static_cast<Index>(a.size()), 0.0,
                                    [&](Index A) { return sum(at(a, A) * at(b, A)); });
}

/// x += a w
inline void add(NodalVectors& x, Real a, const NodalVectors& w) {
  sweep(static_cast<Index>(x.size()), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(x, A) += a * at(w, A);
  });
}

/// a = 0
inline void clear(std::span<NodalVector> a) {
  sweep(static_cast<Index>(a.size()), [&](Index begin, Index end) {
    std::fill(a.begin() + begin, a.begin() + end, Lanes::zero());
  });
}

/// to = from
inline void copy(const NodalVectors& from, NodalVectors& to) {
  to.resize(from.size());
  sweep(static_cast<Index>(to.size()), [&](Index begin, Index end) {
    std::copy(from.begin() + begin, from.begin() + end, to.begin() + begin);
  });
}

/// Sum of the lengths of all vectors.
inline Real sum_of_sizes(const NodalVectors& w) {
  return parallel_sum<Cost::little>(static_cast<Index>(w.size()), 0.0,
                                    [&](Index A) { return std::sqrt(sum(at(w, A) * at(w, A))); });
}

/// The largest length of a vector.
inline Real largest(const NodalVectors& w) {
  Real square = 0;
  for (const NodalVector& x : w) square = std::max(square, sum(x * x));
  return std::sqrt(square);
}

}  // namespace meniscus
