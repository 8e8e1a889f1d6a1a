// SPDX-License-Identifier: BSD-3-Clause
// Contact points per facet: how many, and what their distance costs.
#pragma once
#include "meniscus/body/body.hpp"
#include "meniscus/physics/interaction.hpp"

namespace meniscus {

/// Points that are too far apart make surfaces rough: smooth bodies hold each other as if by
/// friction, and gain spin when they collide. Only the points of the deformable sides count.
struct ContactResolution {
  Real facet;  ///< edge of the larger facets: (area / number)^(1/(D-1)) of a body
  Real gap;    ///< equilibrium gap
  bool rigid;  ///< the other side is a rigid partner

  /// Bound of tangential force / normal force between balls, or of torque / (normal force x
  /// radius) of a ball on a plane, in any orientation, at 0.8 of the equilibrium gap: roughness().
  Real tangential_share(int points) const;
  /// The fewest, at least 2, whose tangential share is below 1e-3; at most 8 (rigid: 4), beyond
  /// which finer facets are cheaper.
  int enough_points() const;
  /// Of points that surfaces cannot pass between without feeling each other.
  Real longest_spacing() const;
  /// Whether two deformable bodies can pass through each other unfelt.
  bool unfelt(int points) const { return !rigid && facet / points > longest_spacing(); }
};

/// A exp(-B gap/spacing) with A and B from surfaces of 96 facets with 2 to 8 Gauss points per
/// direction, where they repel each other clearly (CGCM note 10).
Real roughness(Real gap_per_spacing, bool rigid);

/// Edge of a square (2D: length) of the mean area of the facets of a body.
template <int D>
Real facet_size(const Body<D>& body);

/// The same of the smallest and of the largest facet alone.
struct FacetEdges {
  Real least, largest;
};
template <int D>
FacetEdges facet_edges(const Body<D>& body);

}  // namespace meniscus
