// SPDX-License-Identifier: BSD-3-Clause
// The time step.
#include "meniscus/solve/central_difference.hpp"

#include "meniscus/core/parallel.hpp"

namespace meniscus {
namespace {

/// v += dt f / m
void kick(NodalVectors& v, const NodalVectors& f, const std::vector<Real>& mass, Real dt) {
  for_chunks(static_cast<Index>(v.size()), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(v, A) += (dt / at(mass, A)) * at(f, A);
  });
}
template <int D>
void kick(const System<D>& system, State& state, Real dt) {
  kick(state.v, state.force, system.mass, dt);
  for (Unknown& field : state.fields)
    if (field.spec.evolution == Evolution::inertial) kick(field.rate, field.f, field.capacity, dt);
}

/// x += dt v
void drift(NodalVectors& x, const NodalVectors& v, Real dt) {
  for_chunks(static_cast<Index>(x.size()), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(x, A) += dt * at(v, A);
  });
}
void drift(State& state, Real dt) {
  drift(state.u, state.v, dt);
  for (Unknown& field : state.fields) drift(field.x, field.rate, dt);
}

/// x' = f / c of the relaxational fields. The heat of the step of dt that ends: the work of the
/// mean of both forces on the way that the old rate led.
void settle(State& state, Real dt) {
  for (Unknown& field : state.fields) {
    if (field.spec.evolution != Evolution::relaxational) continue;
    state.books.dissipated +=
        dt / 2 * parallel_sum(static_cast<Index>(field.x.size()), 0.0, [&](Index A) {
          Lanes& rate = at(field.rate, A);
          const Real c = at(field.capacity, A);
          const Real power = sum((at(field.f, A) + c * rate) * rate);
          rate = at(field.f, A) / c;
          return power;
        });
  }
}

}  // namespace

template <int D>
void start(System<D>& system, State& state) {
  state.force.resize(state.u.size());
  const Report report = system.compute_forces(state.motion(), state.forces());
  settle(state, 0);
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
    report = system.compute_forces(state.motion(), state.forces());
  } catch (const SolveError&) {
    drift(state, -dt);
    state.time -= dt;
    throw;
  }
  settle(state, dt);
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
