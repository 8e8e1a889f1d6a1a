// SPDX-License-Identifier: BSD-3-Clause
// How long the clusters of contact points that may feel a rigid partner, whose interaction ends at
// a range, stay the same.
#pragma once
#include "moved_since.hpp"

namespace meniscus {

/// Those within twice the range do until a point can have moved by the range, together with the
/// partner.
template <int D>
class ReachList {
 public:
  explicit ReachList(Real range) : range_(range) {}

  bool holds(const ContactPoints<D>& points, const Motion& motion, const Vec<D>& shift) const {
    const Real left = range_ * (1 - 1e-12) - (shift - shift_).norm();
    return left > 0 && since_.farthest(points, motion) <= left;
  }
  /// The clusters within distance() are found at this motion.
  void begin(const ContactPoints<D>& points, const Motion& motion, const Vec<D>& shift) {
    since_.begin(points, motion);
    shift_ = shift;
    ++times_;
  }
  /// How often that was.
  std::int64_t times() const { return times_; }
  Real distance() const { return 2 * range_; }
  std::size_t bytes() const { return since_.bytes(); }

 private:
  Real range_;
  MovedSince<D> since_;  // it was made
  Vec<D> shift_ = Vec<D>::Zero();
  std::int64_t times_ = 0;
};

}  // namespace meniscus
