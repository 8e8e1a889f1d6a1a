// SPDX-License-Identifier: BSD-3-Clause
// Gap, closing speed and stiffness of a contact.
#include "meniscus/physics/contact_demand.hpp"

#include "meniscus/approx/neighbor_search.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

template <int D>
std::vector<Vec<D>> places(const ContactPlaces<D>& points) {
  std::vector<Vec<D>> x;
  for (Index q = 0; q < points.size; ++q) x.push_back(points.place(q));
  return x;
}

template <int D>
Vec<D> mean_velocity(const ContactPoints<D>& points, std::span<const Index> active,
                     const Motion& motion) {
  Vec<D> mean = Vec<D>::Zero();
  Lanes v[D];
  for (const Index c : active) {
    points.velocity(c, motion, v);
    for (int i = 0; i < D; ++i) mean[i] += sum(v[i]);
  }
  return mean / (4 * std::max<Real>(1, static_cast<Real>(active.size())));
}

template <int D>
Real largest_deviation(const ContactPoints<D>& points, std::span<const Index> active,
                       const Vec<D>& from, const Motion& motion) {
  Lanes largest = Lanes::zero(), v[D];
  for (const Index c : active) {
    points.velocity(c, motion, v);
    Lanes square = Lanes::zero();
    for (int i = 0; i < D; ++i) square += (v[i] - from[i]) * (v[i] - from[i]);
    largest = max(square, largest);
  }
  return std::sqrt(std::max(std::max(largest[0], largest[1]), std::max(largest[2], largest[3])));
}

}  // namespace

template <int D>
Real gap_between(const ContactPlaces<D>& first, const ContactPlaces<D>& second) {
  const std::vector<Vec<D>> x = places(first), y = places(second);
  const NeighborSearch<D> search(y);
  Real gap = std::numeric_limits<Real>::max();
  for (const Vec<D>& point : x) gap = std::min(gap, search.distance_of_nearest(point, 1));
  return gap;
}

template <int D>
Real closing_speed(const ContactPoints<D>& points, std::span<const Index> active,
                   const ContactPoints<D>* other, std::span<const Index> other_active,
                   const Vec<D>& rigid_velocity, const Motion& motion) {
  const Vec<D> mean = other ? mean_velocity(*other, other_active, motion) : rigid_velocity;
  const Real own = largest_deviation(points, active, mean, motion);
  return other ? own + largest_deviation(*other, other_active, mean, motion) : own;
}

StepDemand contact_demand(const ContactInertia& contact, Real gap, Real closing_speed) {
  constexpr Real closed_in_a_step = 0.05;
  StepDemand demand;
  if (!(gap > 0)) return demand;
  if (closing_speed > 0) demand.longest = closed_in_a_step * gap / closing_speed;
  const Real reached = std::max((1 - closed_in_a_step) * gap, contact.interaction.least_gap());
  const Real K = contact.interaction.at(reached).stiffness;
  const Real single = 1 + 2 * std::pow(contact.spacing / reached, contact.dimension - 1);
  demand.stiffness = std::max(0.0, K) * single * contact.inverse_inertia;
  if (demand.stiffness > 0)
    demand.longest = std::min(demand.longest, 1 / std::sqrt(demand.stiffness));
  return demand;
}

std::optional<std::string> unresolved_gap(const std::string& contact, Real gap, Real spacing,
                                          Real range) {
  constexpr Real strong = 0.3;  // part of the range
  if (gap > strong * range || gap >= 2 * spacing) return std::nullopt;
  return fmt::format(
      "contact '{}' is under-resolved: its gap {:.4g} is below twice the distance {:.4g} of its "
      "points; the error of its forces grows from 1 % there to tens of per cent at a gap of one "
      "distance (more points per facet, or finer bodies)",
      contact, gap, spacing);
}

template Real gap_between(const ContactPlaces<2>&, const ContactPlaces<2>&);
template Real gap_between(const ContactPlaces<3>&, const ContactPlaces<3>&);
template Real closing_speed(const ContactPoints<2>&, std::span<const Index>,
                            const ContactPoints<2>*, std::span<const Index>, const Vec<2>&,
                            const Motion&);
template Real closing_speed(const ContactPoints<3>&, std::span<const Index>,
                            const ContactPoints<3>*, std::span<const Index>, const Vec<3>&,
                            const Motion&);

}  // namespace meniscus
