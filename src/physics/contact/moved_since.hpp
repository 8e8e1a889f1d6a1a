// SPDX-License-Identifier: BSD-3-Clause
// How far the contact points of a body can have moved since a motion, by its coefficients alone.
#pragma once
#include "meniscus/physics/contact_points.hpp"

#include <cmath>

namespace meniscus {

/// No point moves farther than ContactPoints::gain() times the largest change of a displacement
/// coefficient: points that are known to be far from a partner need not be moved to know that they
/// still are.
template <int D>
class MovedSince {
 public:
  void begin(const ContactPoints<D>& points, const Motion& motion) {
    const auto u = points.body().part(motion.u);
    u_.clear();
    for (const Index A : points.particles()) u_.push_back(at(u, A));
  }
  /// Infinite before begin().
  Real farthest(const ContactPoints<D>& points, const Motion& motion) const {
    if (u_.empty()) return unbounded;
    const auto u = points.body().part(motion.u);
    Lanes most = Lanes::zero();
    for (std::size_t k = 0; k < u_.size(); ++k) {
      const Lanes change = at(u, points.particles()[k]) - u_[k];
      most = max(most, Lanes(sum(change * change)));
    }
    return points.gain() * std::sqrt(most[0]);
  }
  std::size_t bytes() const { return u_.size() * sizeof(NodalVector); }

 private:
  NodalVectors u_;  // when it began, of the particles that move the points
};

}  // namespace meniscus
