// SPDX-License-Identifier: BSD-3-Clause
// The points of the patches of a wetted face, and the contact line.
#pragma once
#include "body/body.hpp"
#include "body/surface/quadratic_patches.hpp"

#include <vector>

namespace meniscus {

/// A part of the contact line: three points of a quadratic curve (2D: one point), and a point of
/// the face behind it.
template <int D>
struct LinePart {
  static constexpr int nodes = D == 3 ? 3 : 1;
  std::array<Index, nodes> point;
  Index behind;
};

/// Points of a face in the reference configuration.
template <int D>
struct WettedPoints {
  std::vector<Vec<D>> X;
  std::vector<Real> area;  ///< share of each in the area of the face
  std::vector<LinePart<D>> line;
  std::vector<Index> number_on_surface;  ///< of each point, as SurfacePatches numbers them

  WettedPoints(const Geometry<D>& geometry, const std::string& face);
};

}  // namespace meniscus
