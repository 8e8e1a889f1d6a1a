// SPDX-License-Identifier: BSD-3-Clause
// The first state of a run that begins where another run has ended ([initial] from).
#pragma once
#include "scene/scene.hpp"
#include "state/snapshot.hpp"

#include <optional>

namespace meniscus {

/// A saved state of the bodies of a scene.
struct InitialState {
  Snapshot state;
  bool moves;        ///< false if a method that finds states of rest has saved it
  std::string note;  ///< where it is from, for the log
};

/// Reads the state that [initial] of a plan names; empty if it names none. All ranks call this.
/// Throws FileError if there is no state, and InputError if it has other bodies.
template <int D>
std::optional<InitialState> read_initial_state(const Plan<D>& plan);

/// The references of remapped bodies in a saved state. Throws FileError if no bodies can be made of
/// them.
template <int D>
References<D> read_references(const Plan<D>& plan, const Snapshot& state);

/// Builds the scene. With `initial`, its initial state has the positions, velocities and other
/// unknowns of that state, at the time 0. Velocities that the scene gives remain. Throws like
/// build(), and FileError if the state does not fit the bodies.
template <int D>
Scene<D> build_from(const Plan<D>& plan, const std::optional<InitialState>& initial);

/// Saves a hash of the order of the particles, and throws FileError if a state was saved with
/// another order, as other versions may have. Bodies after a remap save their positions instead.
template <int D>
void archive_orders(const System<D>& system, const Archive& a);

}  // namespace meniscus
