// SPDX-License-Identifier: BSD-3-Clause
// Sums and copies of nodal vectors over all particles. In a halo each rank uses the particles that
// it follows. Results have the same bits as those of nodal_algebra.
#pragma once
#include "parallel/halo.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {

/// sum_A a_A . b_A
inline Real dot(const std::shared_ptr<const Halo>& halo, std::span<const NodalVector> a,
                std::span<const NodalVector> b) {
  return sum_over_particles(halo, static_cast<Index>(a.size()), 0.0,
                            [&](Index A) { return sum(at(a, A) * at(b, A)); });
}

/// The largest length of a vector.
inline Real largest(const std::shared_ptr<const Halo>& halo, std::span<const NodalVector> w) {
  struct Greatest {
    Real square;
    Greatest operator+(const Greatest& b) const { return {std::max(square, b.square)}; }
  };
  return std::sqrt(
      sum_over_particles(halo, static_cast<Index>(w.size()), Greatest{0}, [&](Index A) {
        return Greatest{sum(at(w, A) * at(w, A))};
      }).square);
}

/// to = from; both have the same length.
inline void copy(const std::shared_ptr<const Halo>& halo, std::span<const NodalVector> from,
                 std::span<NodalVector> to) {
  for_particles(halo, static_cast<Index>(from.size()), [&](Index begin, Index end) {
    std::copy(from.begin() + begin, from.begin() + end, to.begin() + begin);
  });
}

}  // namespace meniscus
