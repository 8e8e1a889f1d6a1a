// SPDX-License-Identifier: BSD-3-Clause
// The bounding box of the present surface of a body. It does not depend on the positions of
// particles within the body.
#pragma once
#include "body/body.hpp"
#include "body/surface/quadratic_patches.hpp"
#include "numbers/box.hpp"

#include <optional>

namespace meniscus {

/// Every boundary facet is represented by the quadratic patch of PatchNodes through material points
/// of the exact reference surface; the balanced surface tension uses the same surface. When a round
/// body rotates, its facets may miss its farthest points; the patches do not.
template <int D>
class SurfaceExtents {
 public:
  explicit SurfaceExtents(const Body<D>& body) : body_(body) {}

  /// The box around all patches at a motion, and around their images beyond the axis in a body of
  /// revolution. Shape functions are computed at the first call. All
  /// ranks must call this. Throws SolveError if shape functions cannot be determined.
  Box<D> box(const Motion& motion);

 private:
  static constexpr int nodes = PatchFunctions<D>::nodes;
  /// Nodes of the patches. Each rank has the rows of a part of them.
  struct Points {
    std::vector<std::array<Index, nodes>> of_patch;
    std::vector<Vec<D>> X;
    PointRows<D> rows;
  };
  const Points& points();
  std::vector<Vec<D>> places(const Motion& motion);

  const Body<D>& body_;
  std::optional<Points> points_;
};

}  // namespace meniscus
