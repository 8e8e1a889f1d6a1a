// SPDX-License-Identifier: BSD-3-Clause
// Number of contact points per facet, and the error that their distance causes.
#pragma once
#include "body/body.hpp"
#include "physics/contact/gap/interaction.hpp"

namespace meniscus {

/// Contact points that are too far apart make surfaces rough: smooth bodies hold each other as if
/// by friction and gain spin in collisions. Only the points of deformable sides count.
struct ContactResolution {
  Real facet;      ///< edge of the larger facets: (area / number)^(1/(D-1)) of a body
  Real gap;        ///< equilibrium gap
  bool rigid;      ///< true if the other side is a rigid partner
  Real width = 0;  ///< from the equilibrium gap to where the interaction is zero; 0: nowhere

  /// Bound of tangential force / normal force between balls, or of torque / (normal force x radius)
  /// of a ball on a plane, in any orientation, at 0.8 of the equilibrium gap. See roughness().
  Real tangential_share(int points) const;
  /// The smallest number of points, at least 2, with a tangential share below 1e-3. At most 8
  /// (rigid: 4): beyond this finer facets are cheaper. On a rigid partner whose interaction has a
  /// width it is 3 to 6, so that three points lie in the width (wetting note 7).
  int enough_points() const;
  /// The largest spacing of points at which surfaces cannot pass through each other without a
  /// force.
  Real longest_spacing() const;
  /// True if two deformable bodies can pass through each other without a force.
  bool points_miss(int points) const { return !rigid && facet / points > longest_spacing(); }
};

/// A exp(-B gap/spacing). A and B come from surfaces of 96 facets with 2 to 8 Gauss points per
/// direction at gaps with clear repulsion (CGCM note 10).
Real roughness(Real gap_per_spacing, bool rigid);

/// Edge of a square (2D: length of a segment) with the mean area of the facets of a body.
template <int D>
Real facet_size(const Body<D>& body);

/// Like facet_size(), for the smallest and for the largest facet.
struct FacetEdges {
  Real least, largest;
};
template <int D>
FacetEdges facet_edges(const Body<D>& body);

}  // namespace meniscus
