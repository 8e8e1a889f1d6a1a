// SPDX-License-Identifier: BSD-3-Clause
// The contact points of a body that interact with its rigid partner: the clusters of each grade
// that a force visits.
#pragma once
#include "physics/contact/rigid/partner_layers.hpp"
#include "physics/contact/rigid/reach_list.hpp"

namespace meniscus {

/// For an interaction of finite range: keeps as visited the clusters that may come within the range
/// while the list is valid. Their distances are known.
template <int D>
void choose_within_reach(const BodyAndPartner<D>& pair, const ReachList<D>& list,
                         PartnerLayer<D>& layer);

/// For other interactions: gives each facet the grade for the distance of its coarsest points,
/// whose distances are known. It depends on the current motion only.
template <int D>
void choose_grades(const BodyAndPartner<D>& pair, PartnerLayers<D>& layers);

/// Both, at a motion that is known everywhere.
template <int D>
void choose_visited(const BodyAndPartner<D>& pair, const Motion& motion, ReachList<D>& list,
                    PartnerLayers<D>& layers);
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

/// The nearest point among the points of this process.
template <int D>
NearestPoint nearest_point(const BodyAndPartner<D>& pair, const PartnerLayers<D>& layers);
/// The nearer one; of points at the same distance the first.
NearestPoint nearer(const NearestPoint& a, const NearestPoint& b);

}  // namespace meniscus
