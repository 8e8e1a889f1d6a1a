// SPDX-License-Identifier: BSD-3-Clause
// What rest means for bodies that nothing brings back: rigid drift, and the flow in a fluid.
#pragma once
#include "solve/system.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// Takes the rigid motion, to first order in its rotation, out of the change `du` of those bodies
/// on which it does no work against the change `df` of the forces: they drift freely, which changes
/// no shape. In coefficients; both over all particles.
template <int D>
void remove_free_drift(const System<D>& system, const State& state, const NodalVectors& df,
                       NodalVectors& du);

/// How fluids come to rest: no stress is left that brings particles back, so that they are judged
/// by shape and power. The clock is the time sqrt(M L/F) in which the forces F before they cancel
/// (ForceTerm::uncancelled_force) would move the mass M by its extent L.
template <int D>
class FluidRest {
 public:
  /// `fluid`: which bodies are.
  FluidRest(const System<D>& system, const std::vector<bool>& fluid);

  bool any() const { return !bodies_.empty(); }
  bool holds(Index particle) const;

  /// Largest change of a principal axis between two displacements / extent of the bodies.
  Real change(const NodalVectors& before, const NodalVectors& after) const;

  Real clock(Real uncancelled) const;
  /// The same of an energy F L; unbounded where there is none.
  Real clock_of(Real energy) const;
  /// The force that would do the power of the fluids, of their forces and of what is turned into
  /// heat, by moving them by their extent in a time.
  Real force_of_power(const State& state, Real time) const;
  /// Of the fluid whose forces are farthest from balance: the size of their sum and, divided by its
  /// extent, of the sum of their products with the places. Both vanish at equilibrium, and at a
  /// turning point, where nothing moves, they are what sets the fluid in motion again.
  Real unbalanced_force(const State& state) const;

 private:
  /// Lengths of the principal axes (roots of the second moments) of a body, from places.
  Vec<D> axes(const Body<D>& body, const NodalVectors& u) const;

  std::vector<const Body<D>*> bodies_;
  Real mass_ = 0, extent_ = 0;
};

/// "net force (0, -0.02) on body 'block'": of the bodies most of whose forces, which should cancel,
/// do not; empty if there are none.
template <int D>
std::string net_forces(const System<D>& system, const State& state);

/// The same of the forces at a time, to end a message with.
template <int D>
std::string unbalanced(System<D>& system, State& state, Real time);

/// The kinetic energy of a state becomes heat.
template <int D>
void stop_motion(const System<D>& system, State& state);

}  // namespace meniscus
