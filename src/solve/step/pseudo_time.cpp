// SPDX-License-Identifier: BSD-3-Clause
// Steps with the elastic inertia.
#include "solve/step/pseudo_time.hpp"

#include "parallel/nodal_algebra.hpp"
#include "solve/step/leapfrog.hpp"

#include <fmt/core.h>

namespace meniscus {

template <int D>
PseudoTime<D>::PseudoTime(System<D>& system, const typename Relaxation<D>::Tolerances& tolerances,
                          Real safety)
    : Relaxation<D>(system, tolerances), inertia_(system), step_(system, safety) {
  momentum_.assign(last_u_.size(), Lanes::zero());
  acceleration_ = impulse_ = interval_impulse_ = momentum_;
}

template <int D>
void PseudoTime<D>::begin(const State& state) {
  std::fill(momentum_.begin(), momentum_.end(), Lanes::zero());
  starts_ = true;
  Relaxation<D>::begin(state);
}

template <int D>
void PseudoTime<D>::begin_interval() {
  std::fill(interval_impulse_.begin(), interval_impulse_.end(), Lanes::zero());
}

template <int D>
void PseudoTime<D>::take_up(const State& state) {
  inertia_.solve(state.force, acceleration_);
  beyond_ = energy_of_motion(state) - kinetic_energy(system_, state);
}

template <int D>
Real PseudoTime<D>::energy_of_motion(const State& state) const {
  return 0.5 * dot(momentum_, state.v);
}

template <int D>
std::string PseudoTime<D>::effort() const {
  return fmt::format("{} forces for the stable step", step_.evaluations());
}

template <int D>
void PseudoTime<D>::move(State& state, Real dt) {
  if (starts_) {
    if (kinetic_energy(system_, state) > 0) stop_motion(system_, state);
    take_up(state);
    starts_ = false;
  }
  add(momentum_, dt / 2, state.force);
  add(state.v, dt / 2, acceleration_);
  sweep(system_.size(), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(impulse_, A) = dt * at(momentum_, A);
      at(interval_impulse_, A) += at(impulse_, A);
    }
  });
  leapfrog::drift(system_, state, dt);
  Report report;
  try {
    report = system_.compute_forces(state.motion(), state.forces());
  } catch (const SolveError&) {
    leapfrog::drift(system_, state, -dt);
    throw;
  }
  inertia_.solve(state.force, acceleration_);
  add(momentum_, dt / 2, state.force);
  add(state.v, dt / 2, acceleration_);
  leapfrog::conclude(system_, state, report, dt, 0.75);
}

template <int D>
typename PseudoTime<D>::ModeSums PseudoTime<D>::sums_of_step(const State& state) const {
  return system_.sum_over_particles(Lanes::zero(), [&](Index A) {
    const Lanes du = at(state.u, A) - at(last_u_, A);
    const Lanes df = at(state.force, A) - at(last_force_, A);
    return Lanes(-sum(du * df), sum(du * at(impulse_, A)), sum(du * at(state.force, A)),
                 sum(du * at(momentum_, A)));
  });
}

template <int D>
typename PseudoTime<D>::ModeSums PseudoTime<D>::sums_of_interval(const State& state) const {
  return system_.sum_over_particles(Lanes::zero(), [&](Index A) {
    const Lanes &du = at(du_, A), &df = at(df_, A);
    return Lanes(-sum(du * df), sum(du * at(interval_impulse_, A)), sum(du * at(state.force, A)),
                 sum(du * at(momentum_, A)));
  });
}

template <int D>
void PseudoTime<D>::follow_brake(State& state, Real factor, Real omega_dt) {
  for (NodalVector& p : momentum_) p *= factor;
  const Real before = beyond_;
  beyond_ = energy_of_motion(state) - kinetic_energy(system_, state);
  state.books.dissipated += beyond_ - before;
  if (omega_dt > 1) step_.doubt();
}

template <int D>
void PseudoTime<D>::archive(const Archive& a, const State& state) {
  Relaxation<D>::archive(a, state);
  if (a.is_reading() && !a.has("elastic_inertia")) return;
  const Archive own = a.in("elastic_inertia");
  own("momentum", momentum_, D, dimension::momentum);
  own("window_impulse", interval_impulse_, D);
  own("starts", starts_);
  step_.archive(a.in("elastic_step"));
  if (a.is_reading()) take_up(state);
}

template class PseudoTime<2>;
template class PseudoTime<3>;

}  // namespace meniscus
