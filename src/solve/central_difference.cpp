// SPDX-License-Identifier: BSD-3-Clause
// The time step.
#include "meniscus/solve/central_difference.hpp"

#include "meniscus/core/parallel.hpp"

namespace meniscus {
namespace {

/// v += dt f / m
template <int D>
void kick(const System<D>& system, State& state, Real dt) {
  for_chunks(system.size(), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      at(state.v, A) += (dt / at(system.mass, A)) * at(state.force, A);
  });
}

/// x += dt v
void drift(State& state, Real dt) {
  for_chunks(static_cast<Index>(state.u.size()), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(state.u, A) += dt * at(state.v, A);
  });
}

/// What the terms say about the state besides their forces.
template <int D>
void note_terms(const System<D>& system, State& state) {
  state.dissipation_power = state.external_power = 0;
  state.demand = {};
  for (const auto& term : system.terms) {
    state.dissipation_power += term->dissipation();
    state.external_power += term->external_power(state.motion());
    const StepDemand demand = term->step_demand();
    state.demand.stiffness += demand.stiffness;
    state.demand.longest = std::min(state.demand.longest, demand.longest);
  }
}

/// Sums of heat and external work. The heat is that of the half-step velocities: over a step the
/// viscous force does the work dt/2 (f_n + f_n+1).v_n+1/2, of which f_n+1.v_n+1/2 is the power
/// computed last and f_n.v_n+1/2 lies half-way between the power before and that.
template <int D>
void book_energy(const System<D>& system, State& state, Real dt) {
  state.dissipated += dt / 4 * state.dissipation_power;
  state.external_work += dt / 2 * state.external_power;
  note_terms(system, state);
  state.dissipated += 3 * dt / 4 * state.dissipation_power;
  state.external_work += dt / 2 * state.external_power;
}

}  // namespace

template <int D>
void start(System<D>& system, State& state) {
  state.force.resize(state.u.size());
  system.compute_forces(state.motion(), state.force);
  note_terms(system, state);
}

template <int D>
void advance(System<D>& system, State& state, Real dt) {
  kick(system, state, dt / 2);
  drift(state, dt);
  state.time += dt;
  try {
    system.compute_forces(state.motion(), state.force);
  } catch (const SolveError&) {
    drift(state, -dt);
    state.time -= dt;
    throw;
  }
  kick(system, state, dt / 2);
  ++state.step;
  book_energy(system, state, dt);
}

template void start(System<2>&, State&);
template void start(System<3>&, State&);
template void advance(System<2>&, State&, Real);
template void advance(System<3>&, State&, Real);

}  // namespace meniscus
