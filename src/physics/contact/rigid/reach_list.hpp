// SPDX-License-Identifier: BSD-3-Clause
// Validity of the neighbour list of a rigid partner: the clusters that may interact with it. For
// interactions of finite range.
#pragma once
#include "physics/contact/points/moved_since.hpp"

namespace meniscus {

/// The list contains the clusters within twice the range. It is valid while the displacements of
/// any point and of the partner since then add up to less than the range.
template <int D>
class ReachList {
 public:
  explicit ReachList(Real range) : range_(range) {}

  bool holds(const ContactPoints<D>& points, const Motion& motion, const Vec<D>& shift) const {
    const Real left = range_ * (1 - 1e-12) - (shift - shift_).norm();
    return left > 0 && since_.farthest(points, motion) <= left;
  }
  /// Starts a new list. Must be called at the motion for which the clusters within distance() were
  /// found.
  void begin(const ContactPoints<D>& points, const Motion& motion, const Vec<D>& shift) {
    since_.begin(points, motion);
    shift_ = shift;
    ++times_;
  }
  /// Number of calls of begin().
  std::int64_t times() const { return times_; }
  Real distance() const { return 2 * range_; }
  std::size_t bytes() const { return since_.bytes(); }

 private:
  Real range_;
  MovedSince<D> since_;  // displacements since begin()
  Vec<D> shift_ = Vec<D>::Zero();
  std::int64_t times_ = 0;
};

}  // namespace meniscus
