// SPDX-License-Identifier: BSD-3-Clause
// The box around the present surface of a body, whose extents do not depend on where the particles
// of the body happen to be.
#pragma once
#include "body/body.hpp"
#include "body/surface/quadratic_patches.hpp"
#include "numbers/box.hpp"

#include <optional>

namespace meniscus {

/// Every boundary facet is the quadratic patch of PatchNodes through places of material points of
/// the exact reference surface, the surface that balanced tension acts on. Facets of a round body
/// that turns come to other places than its farthest points; the patches between them do not.
template <int D>
class SurfaceExtents {
 public:
  explicit SurfaceExtents(const Body<D>& body) : body_(body) {}

  /// The box around all patches at a motion. Shape functions are computed at the first call. All
  /// ranks call this. Throws SolveError where shape functions cannot be determined.
  Box<D> box(const Motion& motion);

 private:
  static constexpr int nodes = PatchFunctions<D>::nodes;
  /// Points that the patches go through; each rank has the rows of its part of them.
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
