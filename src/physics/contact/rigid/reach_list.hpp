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

  /// Bound of the displacements since begin() of the points that these particles move.
  Real farthest(const ContactPoints<D>& points, std::span<const Index> particles,
                const Motion& motion) const {
    return since_.farthest(points, particles, motion);
  }
  /// True if the list is valid, given the largest displacement of a point and the displacement of
  /// the partner.
  bool holds(Real farthest, const Vec<D>& shift) const {
    const Real left = range_ * (1 - 1e-12) - (shift - shift_).norm();
    return left > 0 && farthest <= left;
  }
  /// Starts a new list. Must be called at the motion for which the clusters within distance() were
  /// found.
  void begin(const ContactPoints<D>& points, const Motion& motion, const Vec<D>& shift) {
    since_.begin(points, motion);
    shift_ = shift;
  }
  Real distance() const { return 2 * range_; }
  std::size_t bytes() const { return since_.bytes(); }

 private:
  Real range_;
  MovedSince<D> since_;  // displacements since begin()
  Vec<D> shift_ = Vec<D>::Zero();
};

}  // namespace meniscus
