// SPDX-License-Identifier: BSD-3-Clause
// Measures of rest for motions without a restoring force: rigid drift, and the flow in a fluid.
#pragma once
#include "solve/system.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// Removes the free rigid motion of bodies from the change `du`. The motion of a body is free if it
/// does no work against the change `df` of the forces; it changes no shape. To first order in the
/// rotation. du and df are coefficients of all particles.
template <int D>
void remove_free_drift(const System<D>& system, const State& state, const NodalVectors& df,
                       NodalVectors& du);

/// Rest of fluids. No stress restores the positions of fluid particles, so that rest is judged by
/// shape and power. The clock is the time sqrt(M L/F) in which the forces F before they cancel
/// (ForceTerm::uncancelled_force) would move the mass M by its extent L.
template <int D>
class FluidRest {
 public:
  /// `fluid` [body]: true for fluids.
  FluidRest(const System<D>& system, const std::vector<bool>& fluid);

  bool any() const { return !bodies_.empty(); }
  bool holds(Index particle) const;

  /// Largest change of a principal axis between two displacements, relative to the extent of the
  /// bodies.
  Real change(const NodalVectors& before, const NodalVectors& after) const;

  Real clock(Real uncancelled) const;
  /// The clock for an energy F L instead of a force; unbounded if the energy is zero.
  Real clock_of(Real energy) const;
  /// The power of the fluids, expressed as a force: moved over the extent of the fluids in the time
  /// `time`, it does this power. The power contains the power of forces on the velocity, and the
  /// heat.
  Real force_of_power(const State& state, Real time) const;
  /// The larger of two sums, for the fluid whose forces are farthest from balance: the size of the
  /// net force, and the size of the sum of f x^T divided by the extent. Both vanish at equilibrium.
  /// At a turning point, where nothing moves, they do not vanish and set the fluid in motion again.
  Real unbalanced_force(const State& state) const;

 private:
  /// Lengths of the principal axes of a body (roots of the second moments of its positions).
  Vec<D> axes(const Body<D>& body, const NodalVectors& u) const;

  std::vector<const Body<D>*> bodies_;
  Real mass_ = 0, extent_ = 0;
};

/// "net force (0, -0.02) on body 'block'" for bodies whose forces should cancel but mostly do not.
/// Empty if there are none.
template <int D>
std::string net_forces(const System<D>& system, const State& state);

/// The net forces at a time, as the end of a message; see net_forces().
template <int D>
std::string unbalanced(System<D>& system, State& state, Real time);

/// Sets velocities to zero and books the kinetic energy as heat.
template <int D>
void stop_motion(const System<D>& system, State& state);

}  // namespace meniscus
