// SPDX-License-Identifier: BSD-3-Clause
// Cavity gap: distances of opposite places of an inner surface.
#pragma once
#include "physics/surface/closed_surface.hpp"

#include <vector>

namespace meniscus {

/// Pairs each facet of an inner surface with the place that its reference normal meets beyond the
/// cavity. Material pairs stay opposite while faces approach each other and slide little.
template <int D>
class CavityGap {
 public:
  /// `of`: the body of the surface.
  CavityGap(const Body<D>& of, const SurfacePoints<D>& reference);

  struct Gap {
    Real width;   ///< distance of the opposite place along the normal; negative once faces crossed
    Index point;  ///< where it is smallest
  };
  /// The narrowest place; infinite without any pair.
  Gap smallest(const typename ClosedSurface<D>::Placed& surface) const;

 private:
  struct Pair {
    Index point, opposite;
  };
  std::vector<Pair> pairs_;
};

}  // namespace meniscus
