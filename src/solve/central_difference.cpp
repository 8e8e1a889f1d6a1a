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

}  // namespace

template <int D>
void start(System<D>& system, State& state) {
  state.force.resize(state.u.size());
  const Report report = system.compute_forces(state.motion(), state.force);
  state.books.begin(report, system.load_power(state.motion()));
  state.demand = report.demand;
}

template <int D>
void advance(System<D>& system, State& state, Real dt) {
  kick(system, state, dt / 2);
  drift(state, dt);
  state.time += dt;
  Report report;
  try {
    report = system.compute_forces(state.motion(), state.force);
  } catch (const SolveError&) {
    drift(state, -dt);
    state.time -= dt;
    throw;
  }
  kick(system, state, dt / 2);
  ++state.step;
  system.commit(state.motion());
  state.books.add(report, system.load_power(state.motion()), dt);
  state.demand = report.demand;
}

template void start(System<2>&, State&);
template void start(System<3>&, State&);
template void advance(System<2>&, State&, Real);
template void advance(System<3>&, State&, Real);

}  // namespace meniscus
