// SPDX-License-Identifier: BSD-3-Clause
// Boundary facets as biquadratic (2D: quadratic) Lagrange patches that share points.
#pragma once
#include "body/grid/grid.hpp"

#include <array>
#include <map>
#include <vector>

namespace meniscus {

/// The Lagrange functions L_a of a patch and their derivatives at a point of [-1, 1]^(D-1). Nodes
/// are at -1, 0, 1 per direction, with the first direction fastest.
template <int D>
struct PatchFunctions {
  static constexpr int nodes = D == 3 ? 9 : 3;
  Real weight = 0;  ///< weight of the point in a Gauss rule
  std::array<Real, nodes> L;
  std::array<std::array<Real, nodes>, D - 1> dL;

  PatchFunctions() = default;
  explicit PatchFunctions(const Vec<D - 1>& xi);
};
/// The functions at the Gauss points of a rule with `points` points per direction.
template <int D>
std::vector<PatchFunctions<D>> patch_functions(int points);

/// The position of node a of a patch, in [-1, 1]^(D-1).
template <int D>
Vec<D - 1> patch_node(int a);

/// The points through which the facets of a grid are patches. Neighbouring facets share points.
template <int D>
struct PatchNodes {
  static constexpr int nodes = PatchFunctions<D>::nodes;
  /// Identifies a point by the grid nodes that it lies between, in ascending order: one node for a
  /// corner, two for the middle of an edge, all nodes of the facet for its middle.
  using Key = std::vector<Index>;

  std::map<Key, Index> number;                  ///< number of the point
  std::vector<std::array<Index, nodes>> facet;  ///< [facet][a] number of the point

  /// Numbers the points in the order in which the facets use them.
  explicit PatchNodes(const Grid<D>& grid);
  Index count() const { return static_cast<Index>(number.size()); }
};

/// The key of the point at a node of a patch.
template <int D>
typename PatchNodes<D>::Key patch_key(const Facet<D>& facet, const Vec<D - 1>& node);

/// A point of a patch: its position and the tangents x_,k.
template <int D>
CellPoint<D, D - 1> patch_place(const PatchFunctions<D>& f,
                                const std::array<Index, PatchFunctions<D>::nodes>& points,
                                const std::vector<Vec<D>>& x) {
  CellPoint<D, D - 1> place{Vec<D>::Zero(), Eigen::Matrix<Real, D, D - 1>::Zero()};
  for (std::size_t a = 0; a < points.size(); ++a) {
    place.X += f.L[a] * at(x, points[a]);
    for (int k = 0; k < D - 1; ++k) place.J.col(k) += at(f.dL, k)[a] * at(x, points[a]);
  }
  return place;
}

}  // namespace meniscus
