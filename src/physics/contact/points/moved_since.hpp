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
    u_.resize(static_cast<std::size_t>(points.body().size()));
    for (const Index A : points.particles()) at(u_, A) = at(u, A);
  }
  /// The bound for points that these particles move, of particles(). Infinite before begin().
  Real farthest(const ContactPoints<D>& points, std::span<const Index> particles,
                const Motion& motion) const {
    if (u_.empty()) return unbounded;
    const auto u = points.body().part(motion.u);
    Real most = 0;
    for (const Index A : particles) {
      const Lanes change = at(u, A) - at(u_, A);
      const Real square = sum(change * change);
      if (std::isnan(square)) return unbounded;
      most = std::max(most, square);
    }
    return points.gain() * std::sqrt(most);
  }
  std::size_t bytes() const { return u_.size() * sizeof(NodalVector); }

 private:
  NodalVectors u_;  // [particle] displacements at begin() of those that move points
};

}  // namespace meniscus
