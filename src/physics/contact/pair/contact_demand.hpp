// SPDX-License-Identifier: BSD-3-Clause
// Limits of contact on the time step, and resolution of its gap.
#pragma once
#include "numbers/box.hpp"
#include "physics/contact/gap/interaction.hpp"
#include "physics/contact/points/contact_points.hpp"

#include <optional>
#include <string>

namespace meniscus {

/// Smallest distance between the points of two bodies.
template <int D>
Real gap_between(const ContactPlaces<D>& first, const ContactPlaces<D>& second);

/// An upper bound of the speed at which active points of two bodies approach each other: the sum of
/// the largest deviations from the mean velocity of `other`.
template <int D>
Real closing_speed(const ContactPoints<D>& points, std::span<const Index> active,
                   const ContactPoints<D>& other, std::span<const Index> other_active,
                   const Motion& motion);
/// The closing speed to a partner that moves with `velocity`, of points known to this process.
template <int D>
Real closing_speed(const ContactPoints<D>& points, std::span<const Index> active,
                   const SharedWork& work, const Vec<D>& velocity, const Motion& motion);

/// Boxes around the position and velocity coefficients that contact points read.
template <int D>
struct CoefficientBoxes {
  Box<D> places, velocities;

  CoefficientBoxes() = default;
  /// Boxes around the coefficients of these particles of the body.
  CoefficientBoxes(const ContactPoints<D>& points, std::span<const Index> particles,
                   const Motion& motion);
  void join(const CoefficientBoxes& other);
};

/// Lower bound of the distance between two bodies, and upper bound of the speed of their approach.
/// Both come from boxes of coefficients, which is cheap for bodies far apart.
struct Approach {
  Real distance, speed;
};
/// For two bodies, from the boxes of all their coefficients: contact points are not moved.
template <int D>
Approach approach(const ContactPoints<D>& first, const CoefficientBoxes<D>& of_first,
                  const ContactPoints<D>& second, const CoefficientBoxes<D>& of_second);
/// For a body at a known distance from a rigid partner that moves with `velocity`.
template <int D>
Approach approach(const ContactPoints<D>& points, const CoefficientBoxes<D>& boxes, Real distance,
                  const Vec<D>& velocity);

/// Limits a step so that bodies get at most a quarter of the range into it. At any speed they
/// interact before they meet.
StepDemand approach_demand(const Approach& approach, Real range);

/// Closing speed of a gap: points within the distance `within` of the partner approach it at
/// `speed`, all other points at most at `fastest`.
struct ClosingSpeed {
  Real speed, within = unbounded, fastest = 0;
};
/// A distance `within` beyond which points rarely limit the step.
inline Real close_by(Real gap) {
  return 2 * gap;
}

/// The quantities of a contact that give its stiffness.
struct ContactInertia {
  const Interaction& interaction;
  Real inverse_inertia;  ///< sum of 1 / inertia of the points of both sides
  Real spacing;          ///< of the points; 0 if the other side has no quadrature
  int dimension;
};

/// Limits of a contact on the time step. The step closes at most 1/20 of the gap. The stiffness is
/// taken for two planes at the smallest gap within reach of the step (CGCM notes 3.1 and 8). It is
/// multiplied by 1 + 2 (spacing/gap)^(D-1), since widely spaced points of the other side act as
/// single points. The step is at most half the stable step of this stiffness: springs whose
/// stiffness changes by multiples heat up at longer steps.
StepDemand contact_demand(const ContactInertia& contact, Real gap, const ClosingSpeed& closing);

/// A warning if the points are more than half a gap apart and the gap is in the strong part of
/// `range`; otherwise empty.
std::optional<std::string> unresolved_gap(const std::string& contact, Real gap, Real spacing,
                                          Real range);

}  // namespace meniscus
