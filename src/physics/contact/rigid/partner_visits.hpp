// SPDX-License-Identifier: BSD-3-Clause
// The contact points of a body that interact with its rigid partner: the clusters of each grade
// that a force visits.
#pragma once
#include "physics/contact/rigid/partner_layers.hpp"
#include "physics/contact/rigid/reach_list.hpp"

namespace meniscus {

/// Chooses the visited clusters. For an interaction of finite range, these are the clusters that
/// may be within the range while the list is valid. For others, clusters are chosen by the grades
/// of facets.
template <int D>
void choose_visited(const BodyAndPartner<D>& pair, const Motion& motion, ReachList<D>& list,
                    PartnerLayers<D>& layers);

/// Gives each facet the grade for the distance of its coarsest points, which are moved here. It
/// depends on the current motion only. Does nothing if there is one grade.
template <int D>
void choose_grades(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers);

/// Sets `near` of the layers: visited clusters within the range.
template <int D>
void find_near(const BodyAndPartner<D>& pair, PartnerLayers<D>& layers);

/// A point of a grade.
struct NearestPoint {
  Real distance = unbounded;
  std::size_t grade = 0;
  Index point = 0;
};

/// Nearest point and number of visited points, over all ranks.
struct VisitedPoints {
  NearestPoint nearest;
  Offset count = 0;
};
/// Returns the nearest point and the number of visited points. If no point is within the range, the
/// distances of all points are updated to this motion, visited or not.
template <int D>
VisitedPoints visited_points(const BodyAndPartner<D>& pair, const Motion& motion,
                             PartnerLayers<D>& layers);

}  // namespace meniscus
