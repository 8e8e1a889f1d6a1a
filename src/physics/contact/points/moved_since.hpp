// SPDX-License-Identifier: BSD-3-Clause
// Upper bound of the displacement of contact points since a motion, from the coefficients alone.
#pragma once
#include "physics/contact/points/contact_points.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus {

/// No point moves farther than ContactPoints::gain() times the largest change of a displacement
/// coefficient. So points far from a partner need not be computed to show that they are still far.
template <int D>
class MovedSince {
 public:
  void begin(const ContactPoints<D>& points, const Motion& motion) {
    const auto u = points.body().part(motion.u);
    u_.clear();
    for (const Index A : points.particles()) u_.push_back(at(u, A));
  }
  /// The bound; infinite before begin(). In a halo all ranks have to call this.
  Real farthest(const ContactPoints<D>& points, const Motion& motion) const {
    if (u_.empty()) return unbounded;
    const auto u = points.body().part(motion.u);
    Lanes most = Lanes::zero();
    points.for_own_particles([&](Index k) {
      const Lanes change = at(u, at(points.particles(), k)) - at(u_, k);
      most = max(most, Lanes(sum(change * change)));
    });
    Real square = most[0];
    if (points.in_halo())
      for (const Real of_rank : said_by_ranks(square)) square = std::max(square, of_rank);
    return points.gain() * std::sqrt(square);
  }
  std::size_t bytes() const { return u_.size() * sizeof(NodalVector); }

 private:
  NodalVectors u_;  // displacements at begin() of particles that move points
};

}  // namespace meniscus
