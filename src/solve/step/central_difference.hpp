// SPDX-License-Identifier: BSD-3-Clause
// Explicit dynamics by central differences (velocity Verlet, so that the state is complete at whole
// steps). The viscous force uses the velocity of the half step. Relaxational fields are advanced by
// explicit Euler steps, which are of first order.
#pragma once
#include "solve/system.hpp"

#include <functional>

namespace meniscus {

/// Computes the forces of the initial state. Call this once before the first step of a new run; the
/// state of a continued run contains its forces.
template <int D>
void start(System<D>& system, State& state);

/// Makes one step. Throws SolveError (System::compute_forces). `state` then has the positions
/// before the step and the velocities of the half step, and its forces are invalid. judge(state) is
/// called with the new state before the step is accepted. If it throws, `state` is the state after
/// the step.
template <int D>
void advance(System<D>& system, State& state, Real dt,
             const std::function<void(const State&)>& judge = {});

}  // namespace meniscus
