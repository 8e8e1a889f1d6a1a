// SPDX-License-Identifier: BSD-3-Clause
// The time step of central differences.
#include "solve/step/central_difference.hpp"

#include "solve/step/leapfrog.hpp"

namespace meniscus {

template <int D>
void start(System<D>& system, State& state) {
  state.force.resize(state.u.size());
  if (system.constraints) system.constraints->make_consistent(state);
  state.energies_asked = false;
  state.energies.reserve(system.terms.size());
  const Report report = system.compute_forces(state.motion(), state.forces());
  if (system.constraints) system.constraints->begin(state);
  leapfrog::settle(state, 0);
  state.books.begin(report, system.load_power(state.motion()));
  state.demand = report.demand;
}

template <int D>
void advance(System<D>& system, State& state, Real dt,
             const std::function<void(const State&)>& judge) {
  system.depart(state);
  leapfrog::kick_and_drift(system, state, dt);
  system.constrain(state, dt);
  system.arrive(state, dt);
  Report report;
  try {
    report = system.compute_forces(state.motion(), state.forces());
  } catch (const SolveError&) {
    leapfrog::drift(system, state, -dt);
    throw;
  }
  system.react(state, dt);
  leapfrog::settle(state, dt);
  leapfrog::kick(system, state, dt / 2);
  if (judge) judge(state);
  // The viscous work of a step is dt/2 (f_n + f_n+1).v_n+1/2. The power computed last is
  // f_n+1.v_n+1/2; f_n.v_n+1/2 is the mean of the previous power and the last one.
  leapfrog::conclude(system, state, report, dt, 0.75);
}

template void start(System<2>&, State&);
template void start(System<3>&, State&);
template void advance(System<2>&, State&, Real, const std::function<void(const State&)>&);
template void advance(System<3>&, State&, Real, const std::function<void(const State&)>&);

}  // namespace meniscus
