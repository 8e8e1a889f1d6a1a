// SPDX-License-Identifier: BSD-3-Clause
// Demand of contact on the time step, and resolution of its gap.
#pragma once
#include "meniscus/physics/contact_points.hpp"
#include "meniscus/physics/interaction.hpp"

#include <optional>
#include <string>

namespace meniscus {

/// Smallest distance between the points of two bodies.
template <int D>
Real gap_between(const ContactPlaces<D>& first, const ContactPlaces<D>& second);

/// A bound of the speed at which active points of a body and of `other` approach: largest
/// deviations from the mean velocity of the other's. Without another body its points move with
/// `rigid_velocity`.
template <int D>
Real closing_speed(const ContactPoints<D>& points, std::span<const Index> active,
                   const ContactPoints<D>* other, std::span<const Index> other_active,
                   const Vec<D>& rigid_velocity, const Motion& motion);

/// How near bodies are at least and how fast they can come nearer, from boxes around places and
/// velocities: cheap, while they are far apart.
struct Approach {
  Real distance, speed;
};
/// Of two bodies by their coefficients alone: no contact point has to be moved.
template <int D>
Approach approach(const ContactPoints<D>& first, const ContactPoints<D>& second,
                  const Motion& motion);
/// Of a body and a rigid partner with `velocity`, whose distance is known.
template <int D>
Approach approach(const ContactPoints<D>& points, Real distance, const Vec<D>& velocity,
                  const Motion& motion);

/// A step brings bodies that do not interact yet at most a quarter of the range into it: at any
/// speed they interact before they meet.
StepDemand approach_demand(const Approach& approach, Real range);

/// How fast a gap closes: points within the distance `within` of the partner approach it at
/// `speed`, all others at `fastest` at most.
struct ClosingSpeed {
  Real speed, within = unbounded, fastest = 0;
};
/// A `within` for which the others seldom matter.
inline Real close_by(Real gap) {
  return 2 * gap;
}

/// The numbers of a contact that decide its stiffness.
struct ContactInertia {
  const Interaction& interaction;
  Real inverse_inertia;  ///< sum of 1 / inertia of the points of both sides
  Real spacing;          ///< of the points; 0: no quadrature on the other side
  int dimension;
};

/// A step closes at most 1/20 of the gap, and the stiffness is that of two planes at the gap it can
/// reach (CGCM notes 3.1 and 8); (1 + 2 (spacing/gap)^(D-1)) K where the points of the other side
/// are so far apart that the force of single ones shows. The step is at most half the stable one of
/// that stiffness: so stiff a spring whose stiffness changes by multiples heats up at longer steps.
StepDemand contact_demand(const ContactInertia& contact, Real gap, const ClosingSpeed& closing);

/// A sentence if the points are more than half a gap apart where the interaction, of that range, is
/// strong.
std::optional<std::string> unresolved_gap(const std::string& contact, Real gap, Real spacing,
                                          Real range);

}  // namespace meniscus
