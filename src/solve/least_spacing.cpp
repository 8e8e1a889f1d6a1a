// SPDX-License-Identifier: BSD-3-Clause
// The smallest distance between two particles of a body, by the tree of their search.
#include "meniscus/solve/least_spacing.hpp"

#include "meniscus/core/parallel.hpp"

#include <algorithm>

namespace meniscus {

template <int D>
Real least_spacing(const std::deque<Body<D>>& bodies) {
  Real least = unbounded;
  for (const Body<D>& body : bodies) {
    std::vector<Real> of_chunk(static_cast<std::size_t>(chunk_count(body.size())), unbounded);
    for_chunks(body.size(), [&](Index chunk, Index begin, Index end) {
      Real& spacing = at(of_chunk, chunk);
      for (Index A = begin; A < end; ++A)
        spacing = std::min(
            spacing, body.particles.search().distance_of_nearest(at(body.particles.X(), A), 2));
    });
    least = std::min(least, *std::min_element(of_chunk.begin(), of_chunk.end()));
  }
  return least;
}

template Real least_spacing(const std::deque<Body<2>>&);
template Real least_spacing(const std::deque<Body<3>>&);

}  // namespace meniscus
