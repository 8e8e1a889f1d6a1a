// SPDX-License-Identifier: BSD-3-Clause
// Which contact points of a body feel its rigid partner: the clusters of each grade that a force
// visits.
#pragma once
#include "partner_layers.hpp"
#include "reach_list.hpp"

namespace meniscus {

/// Of an interaction that ends, clusters that may be within its range, as long as the list holds;
/// else by the grades of facets.
template <int D>
void choose_visited(const BodyAndPartner<D>& pair, const Motion& motion, ReachList<D>& list,
                    PartnerLayers<D>& layers);

/// Each facet has the grade that it needs at the distance of its coarsest points, which are moved:
/// by the present motion alone. Where there is one grade, all stays as it is.
template <int D>
void choose_grades(const BodyAndPartner<D>& pair, const Motion& motion, PartnerLayers<D>& layers);

/// Of the clusters visited those within the range.
template <int D>
void find_near(const BodyAndPartner<D>& pair, PartnerLayers<D>& layers);

/// A point of a grade.
struct NearestPoint {
  Real distance = unbounded;
  std::size_t grade = 0;
  Index point = 0;
};

/// Of all ranks.
struct VisitedPoints {
  NearestPoint nearest;
  Offset count = 0;
};
/// If no point is within the range, every point has the distance of this motion afterwards, visited
/// or not.
template <int D>
VisitedPoints visited_points(const BodyAndPartner<D>& pair, const Motion& motion,
                             PartnerLayers<D>& layers);

}  // namespace meniscus
