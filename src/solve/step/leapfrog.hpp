// SPDX-License-Identifier: BSD-3-Clause
// Parts of a step of central differences, in which positions and velocities are half a step apart.
#pragma once
#include "parallel/nodal_algebra.hpp"
#include "solve/system.hpp"

namespace meniscus::leapfrog {

/// v += dt f / m, for vectors over all particles.
inline void kick(NodalVectors& v, const NodalVectors& f, const std::vector<Real>& mass, Real dt) {
  sweep(static_cast<Index>(v.size()), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(v, A) += (dt / at(mass, A)) * at(f, A);
  });
}
inline void kick_fields(State& state, Real dt) {
  for (Unknown& field : state.fields)
    if (field.spec.evolution == Evolution::inertial) kick(field.rate, field.f, field.capacity, dt);
}
template <int D>
void kick(const System<D>& system, State& state, Real dt) {
  system.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      at(state.v, A) += (dt / at(system.mass, A)) * at(state.force, A);
  });
  kick_fields(state, dt);
}

/// x += dt v for fields beside the displacement.
inline void drift_fields(State& state, Real dt) {
  for (Unknown& field : state.fields)
    if (field.spec.evolution != Evolution::carried) add(field.x, dt, field.rate);
}
template <int D>
void drift(const System<D>& system, State& state, Real dt) {
  system.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(state.u, A) += dt * at(state.v, A);
  });
  drift_fields(state, dt);
  state.time += dt;
}

/// The first half kick of the displacement and all inertial fields, and the drift.
template <int D>
void kick_and_drift(const System<D>& system, State& state, Real dt) {
  system.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(state.v, A) += (dt / 2 / at(system.mass, A)) * at(state.force, A);
      at(state.u, A) += dt * at(state.v, A);
    }
  });
  kick_fields(state, dt / 2);
  drift_fields(state, dt);
  state.time += dt;
}

/// Sets the rates x' = f / c of relaxational fields. Adds the heat of the step of dt that ends: the
/// mean of the forces before and after it, times the old rate.
inline void settle(State& state, Real dt) {
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

/// Accepts the step of dt with the report of its forces. The heat of the step is weighted: the new
/// power counts `last_share`, the old one the rest.
template <int D>
void conclude(System<D>& system, State& state, const Report& report, Real dt, Real last_share) {
  ++state.step;
  system.commit(state.motion());
  state.books.add(report, system.load_power(state.motion()), dt, last_share);
  state.demand = report.demand;
}

}  // namespace meniscus::leapfrog
