// SPDX-License-Identifier: BSD-3-Clause
// Gap, closing speed and stiffness of a contact.
#include "physics/contact/pair/contact_demand.hpp"

#include "kernel/neighbor_search.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meniscus {
namespace {

template <int D>
std::vector<Vec<D>> list_of(const ContactPlaces<D>& points) {
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
    points.velocity_nearby(c, motion, v);
    for (int i = 0; i < D; ++i) mean[i] += sum(v[i]);
  }
  return mean / (4 * std::max<Real>(1, static_cast<Real>(active.size())));
}

/// The largest |v - from| of points. velocity(cluster, v) sets the velocities of four of them.
template <int D, class F>
Real largest_deviation(std::span<const Index> active, const Vec<D>& from, F&& velocity) {
  Lanes largest = Lanes::zero(), v[D];
  for (const Index c : active) {
    velocity(c, v);
    Lanes square = Lanes::zero();
    for (int i = 0; i < D; ++i) square += (v[i] - from[i]) * (v[i] - from[i]);
    largest = max(square, largest);
  }
  return std::sqrt(std::max(std::max(largest[0], largest[1]), std::max(largest[2], largest[3])));
}

/// A box that contains sum_A N_A c_A at all contact points if `coefficients` contains all c_A. A
/// value differs from the centre by at most sum_A |N_A| times the largest difference of a
/// coefficient.
template <int D>
Box<D> of_points(const Box<D>& coefficients, const ContactPoints<D>& points) {
  const Vec<D> half = points.gain() / 2 * coefficients.extent(), centre = coefficients.centre();
  return {centre - half, centre + half};
}

template <int D>
Real distance_between(const Box<D>& a, const Box<D>& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(Vec<D>::Zero()).norm();
}
template <int D>
Real farthest_between(const Box<D>& a, const Box<D>& b) {
  return (a.high - b.low).cwiseAbs().cwiseMax((b.high - a.low).cwiseAbs()).norm();
}

}  // namespace

/// Least distance of two bodies. Only few points can be the nearest. A first upper bound is the
/// distance from the point of the first body nearest to the box around the second. Points of the
/// first body farther than this from that box are dropped, then points of the second body farther
/// from the box around the rest.
template <int D>
Real gap_between(const ContactPlaces<D>& first, const ContactPlaces<D>& second) {
  constexpr Real round_off = 1e-12;
  std::vector<Vec<D>> x = list_of(first), y = list_of(second);
  const auto from = [](const Box<D>& box) {
    return [&box](const Vec<D>& p) { return distance_between({p, p}, box); };
  };
  const auto least = [](const std::vector<Vec<D>>& points, const auto& distance) {
    return *std::ranges::min_element(points, {}, distance);
  };
  const auto keep = [](std::vector<Vec<D>>& points, Real bound, const auto& distance) {
    std::erase_if(points, [&](const Vec<D>& p) { return distance(p) > bound; });
  };
  const Box<D> around_second = box_around<D>(y);
  const Vec<D> start = least(x, from(around_second));
  const auto from_start = [&](const Vec<D>& p) { return (p - start).norm(); };
  const Real bound = (1 + round_off) * from_start(least(y, from_start));
  keep(x, bound, from(around_second));
  const Box<D> around_first = box_around<D>(x);
  keep(y, bound, from(around_first));
  const NeighborSearch<D> search(y);
  Real gap = std::numeric_limits<Real>::max();
  for (const Vec<D>& point : x) gap = std::min(gap, search.distance_of_nearest(point, 1));
  return gap;
}

template <int D>
Real closing_speed(const ContactPoints<D>& points, std::span<const Index> active,
                   const ContactPoints<D>& other, std::span<const Index> other_active,
                   const Motion& motion) {
  const Vec<D> mean = mean_velocity(other, other_active, motion);
  const auto of = [&](const ContactPoints<D>& side) {
    return [&](Index c, Lanes* v) { side.velocity_nearby(c, motion, v); };
  };
  return largest_deviation<D>(active, mean, of(points)) +
         largest_deviation<D>(other_active, mean, of(other));
}

template <int D>
Real closing_speed(const ContactPoints<D>& points, std::span<const Index> active,
                   const SharedWork& work, const Vec<D>& velocity, const Motion& motion) {
  return largest_deviation<D>(active, velocity, [&](Index c, Lanes* v) {
    points.velocity_nearby(c, work, velocity, motion, v);
  });
}

template <int D>
CoefficientBoxes<D>::CoefficientBoxes(const ContactPoints<D>& points,
                                      std::span<const Index> particles, const Motion& motion) {
  const auto u = points.body().part(motion.u), v = points.body().part(motion.v);
  for (const Index A : particles) {
    Vec<D> d = at(points.body().particles.X(), A), rate;
    for (int i = 0; i < D; ++i) {
      d[i] += at(u, A)[i];
      rate[i] = at(v, A)[i];
    }
    places.include(d);
    velocities.include(rate);
  }
}

template <int D>
void CoefficientBoxes<D>::join(const CoefficientBoxes& other) {
  for (auto [box, added] :
       {std::pair{&places, &other.places}, std::pair{&velocities, &other.velocities}}) {
    box->low = box->low.cwiseMin(added->low);
    box->high = box->high.cwiseMax(added->high);
  }
}

template <int D>
Approach approach(const ContactPoints<D>& first, const CoefficientBoxes<D>& of_first,
                  const ContactPoints<D>& second, const CoefficientBoxes<D>& of_second) {
  return {distance_between(of_points(of_first.places, first), of_points(of_second.places, second)),
          farthest_between(of_points(of_first.velocities, first),
                           of_points(of_second.velocities, second))};
}

template <int D>
Approach approach(const ContactPoints<D>& points, const CoefficientBoxes<D>& boxes, Real distance,
                  const Vec<D>& velocity) {
  return {distance,
          farthest_between(of_points(boxes.velocities, points), Box<D>{velocity, velocity})};
}

StepDemand approach_demand(const Approach& approach, Real range) {
  constexpr Real into_range = 0.25;
  StepDemand demand;
  if (approach.speed > 0)
    demand.longest =
        (std::max(0.0, approach.distance - range) + into_range * range) / approach.speed;
  return demand;
}

StepDemand contact_demand(const ContactInertia& contact, Real gap, const ClosingSpeed& closing) {
  const Real closed_in_a_step = contact.interaction.hardens() ? 0.05 : 0.1;
  StepDemand demand;
  if (!(gap > 0)) return demand;
  if (closing.speed > 0) demand.longest = closed_in_a_step * gap / closing.speed;
  if (closing.fastest > 0)
    demand.longest =
        std::min(demand.longest, (closing.within - (1 - closed_in_a_step) * gap) / closing.fastest);
  const Real reached = std::max((1 - closed_in_a_step) * gap, contact.interaction.least_gap());
  const Real K = contact.interaction.at(reached).stiffness;
  const Real single = 1 + 2 * std::pow(contact.spacing / reached, contact.dimension - 1);
  demand.stiffness = std::max(0.0, K) * single * contact.inverse_inertia;
  if (demand.stiffness > 0 && contact.interaction.hardens())
    demand.longest = std::min(demand.longest, 1 / std::sqrt(demand.stiffness));
  return demand;
}

std::optional<std::string> unresolved_gap(const std::string& contact, Real gap, Real spacing,
                                          Real range) {
  constexpr Real strong = 0.3;  // a fraction of the range
  if (gap > strong * range || gap >= 2 * spacing) return std::nullopt;
  return fmt::format(
      "contact '{}' is under-resolved: its gap {:.4g} is below twice the distance {:.4g} of its "
      "points; the error of its forces grows from 1 % there to tens of per cent at a gap of one "
      "distance (more points per facet, or finer bodies)",
      contact, gap, spacing);
}

#define MENISCUS_INSTANTIATE(D)                                                                   \
  template Real gap_between(const ContactPlaces<D>&, const ContactPlaces<D>&);                    \
  template Real closing_speed(const ContactPoints<D>&, std::span<const Index>,                    \
                              const ContactPoints<D>&, std::span<const Index>, const Motion&);    \
  template Real closing_speed(const ContactPoints<D>&, std::span<const Index>, const SharedWork&, \
                              const Vec<D>&, const Motion&);                                      \
  template struct CoefficientBoxes<D>;                                                            \
  template Approach approach(const ContactPoints<D>&, const CoefficientBoxes<D>&,                 \
                             const ContactPoints<D>&, const CoefficientBoxes<D>&);                \
  template Approach approach(const ContactPoints<D>&, const CoefficientBoxes<D>&, Real,           \
                             const Vec<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
