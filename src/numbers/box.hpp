// SPDX-License-Identifier: BSD-3-Clause
// Bounding boxes of points, with faces normal to the axes.
#pragma once
#include "numbers/types.hpp"

namespace meniscus {

template <int D>
struct Box {
  Vec<D> low = Vec<D>::Constant(unbounded), high = -low;

  void include(const Vec<D>& x) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  void include(const Box& other) {
    include(other.low);
    include(other.high);
  }
  /// Moves each face outwards by `margin`.
  void grow(Real margin) {
    low.array() -= margin;
    high.array() += margin;
  }
  /// True if the boxes have a point in common.
  bool meets(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  Vec<D> extent() const { return high - low; }
  Vec<D> centre() const { return 0.5 * (low + high); }
};

/// The bounding box of a range of Vec<D>.
template <int D, class Points>
Box<D> box_around(const Points& points) {
  Box<D> box;
  for (const Vec<D>& x : points) box.include(x);
  return box;
}

}  // namespace meniscus
