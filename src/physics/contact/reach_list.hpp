// SPDX-License-Identifier: BSD-3-Clause
// How long the clusters of contact points that may feel a rigid partner, whose interaction ends at
// a range, stay the same.
#pragma once
#include "meniscus/physics/contact_points.hpp"

#include <cmath>

namespace meniscus {

/// Those within twice the range do until a point can have moved by the range: no point moves
/// farther than ContactPoints::gain() times the largest change of a displacement coefficient, and
/// the partner by its own displacement.
template <int D>
class ReachList {
 public:
  explicit ReachList(Real range) : range_(range) {}

  bool holds(const ContactPoints<D>& points, const Motion& motion, const Vec<D>& shift) const {
    if (u_.empty()) return false;
    const Real left = range_ * (1 - 1e-12) - (shift - shift_).norm();
    return left > 0 && points.gain() * largest_change(points, motion) <= left;
  }
  /// The clusters within distance() are found at this motion.
  void begin(const ContactPoints<D>& points, const Motion& motion, const Vec<D>& shift) {
    const auto u = points.body().part(motion.u);
    u_.assign(u.begin(), u.end());
    shift_ = shift;
  }
  Real distance() const { return 2 * range_; }
  std::size_t bytes() const { return u_.size() * sizeof(NodalVector); }

 private:
  Real largest_change(const ContactPoints<D>& points, const Motion& motion) const {
    const auto u = points.body().part(motion.u);
    Lanes most = Lanes::zero();
    for (std::size_t A = 0; A < u_.size(); ++A) {
      const Lanes change = u[A] - u_[A];
      most = max(most, Lanes(sum(change * change)));
    }
    return std::sqrt(most[0]);
  }

  Real range_;
  NodalVectors u_;  // when it was made
  Vec<D> shift_ = Vec<D>::Zero();
};

}  // namespace meniscus
