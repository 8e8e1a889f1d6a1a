// SPDX-License-Identifier: BSD-3-Clause
// The smallest distance between two particles of a body, found with the tree of the neighbour
// search.
#include "solve/least_spacing.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>

namespace meniscus {

template <int D>
Real least_spacing(const std::deque<Body<D>>& bodies) {
  Real least = unbounded;
  for (const Body<D>& body : bodies) {
    const OwnItems own = body.own_particles();
    std::vector<Real> of_chunk(static_cast<std::size_t>(chunk_count(own.end - own.begin)),
                               unbounded);
    for_chunks(own.end - own.begin, [&](Index chunk, Index begin, Index end) {
      Real& spacing = at(of_chunk, chunk);
      for (Index A = own.begin + begin; A < own.begin + end; ++A)
        spacing = std::min(
            spacing, body.particles.search().distance_of_nearest(at(body.particles.X(), A), 2));
    });
    for (const Real spacing : of_chunk) least = std::min(least, spacing);
  }
  for (const Real of_rank : said_by_ranks(least)) least = std::min(least, of_rank);
  return least;
}

template Real least_spacing(const std::deque<Body<2>>&);
template Real least_spacing(const std::deque<Body<3>>&);

}  // namespace meniscus
