// SPDX-License-Identifier: BSD-3-Clause
// Explicit dynamics: central differences with the viscous force taken at the velocity of the half
// step before (as velocity Verlet, so that the state is complete at whole steps). Relaxational
// fields follow by explicit Euler steps, of first order.
#pragma once
#include "solve/system.hpp"

#include <functional>

namespace meniscus {

/// Forces at the initial state; call once before the first step of a new run (a continued run has
/// its forces in the state).
template <int D>
void start(System<D>& system, State& state);

/// One step. Throws SolveError (System::compute_forces); `state` is then set back to the places
/// before the step, with the velocities of the half step, and its forces are not valid.
/// `judge`: sees the state before it stands, and may throw; the state is then that after the step.
template <int D>
void advance(System<D>& system, State& state, Real dt,
             const std::function<void(const State&)>& judge = {});

}  // namespace meniscus
