// SPDX-License-Identifier: BSD-3-Clause
// Fast inertial relaxation and the judgement that a state is at rest.
//
// Why FIRE: a bent plate (756 particles) loses all but 1e-4 of its energy in 2000 steps, critically
// damped at the Rayleigh quotient of its motion in 3800; kinetic damping stops at every vibration
// of the stiffest modes and has lost a quarter of it after 5000.
#include "meniscus/solve/relaxation.hpp"

#include "meniscus/approx/row_sums.hpp"
#include "meniscus/core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {
namespace {

// Numbers of FIRE as published, at a constant step.
constexpr Real first_mixing = 0.1, mixing_decay = 0.99;
constexpr std::int64_t patience = 5;  // steps downhill before the mixing decays

template <int D>
Real kinetic_energy(const System<D>& system, const State& state) {
  return parallel_sum(system.size(), 0.0, [&](Index A) {
    return 0.5 * at(system.mass, A) * sum(at(state.v, A) * at(state.v, A));
  });
}

void add(Snapshot& snapshot, const char* name, const NodalVectors& field) {
  snapshot.add_reals(name, {reinterpret_cast<const Real*>(field.data()), 4 * field.size()});
}
void copy(const Snapshot& snapshot, const char* name, NodalVectors& field) {
  snapshot.copy_to(name, {reinterpret_cast<Real*>(field.data()), 4 * field.size()});
}

}  // namespace

template <int D>
Relaxation<D>::Relaxation(System<D>& system, const Tolerances& tolerances)
    : system_(system), tolerances_(tolerances) {}

template <int D>
void Relaxation<D>::begin(const State& state) {
  mixing_ = first_mixing;
  downhill_steps_ = settled_periods_ = 0;
  shape_change_ = 1;
  open_period(state, 0);
}

template <int D>
Real Relaxation<D>::steady_after() const {
  Real last = 0;
  for (const auto& term : system_.terms) last = std::max(last, term->steady_after());
  return last;
}

template <int D>
void Relaxation<D>::lead(State& state, Real dt) {
  const Real before = kinetic_energy(system_, state);
  const Real work = parallel_sum(system_.size(), 0.0,
                                 [&](Index A) { return sum(at(state.force, A) * at(state.v, A)); });
  if (work > 0)
    turn(state, before);
  else
    stop(state);
  const Real after = kinetic_energy(system_, state);
  state.dissipated += before - after;
  // Powers go with the velocity: exactly for loads, as its square for viscous forces.
  state.external_power = 0;
  for (const auto& term : system_.terms)
    state.external_power += term->external_power(state.motion());
  state.dissipation_power *= before > 0 ? after / before : 0;
  judge(state, dt);
}

template <int D>
void Relaxation<D>::stop(State& state) {
  for_chunks(system_.size(), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(state.v, A) = Lanes::zero();
  });
  mixing_ = first_mixing;
  downhill_steps_ = 0;
}

/// v <- (1 - alpha) v + alpha |v| a/|a| with a = M^-1 f and |.| in the metric of the masses, so
/// that forces without resultant give no momentum.
template <int D>
void Relaxation<D>::turn(State& state, Real kinetic) {
  const Real acceleration = std::sqrt(parallel_sum(system_.size(), 0.0, [&](Index A) {
    return sum(at(state.force, A) * at(state.force, A)) / at(system_.mass, A);
  }));
  const Real push = mixing_ * std::sqrt(2 * kinetic) / acceleration;
  for_chunks(system_.size(), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      at(state.v, A) =
          (1 - mixing_) * at(state.v, A) + (push / at(system_.mass, A)) * at(state.force, A);
  });
  if (++downhill_steps_ > patience) mixing_ *= mixing_decay;
}

template <int D>
void Relaxation<D>::open_period(const State& state, Real length) {
  period_u_ = state.u;
  period_force_ = state.force;
  period_begin_ = state.time;
  period_length_ = length;
}

template <int D>
void Relaxation<D>::judge(const State& state, Real dt) {
  constexpr Real fewest_steps = 20;
  const Real elapsed = state.time - period_begin_;
  if (elapsed < std::max(period_length_, fewest_steps * dt) * (1 - 1e-9)) return;
  const Real omega = frequency(state);
  const Real quarter = omega > 0 ? std::numbers::pi / (2 * omega) : 2 * elapsed;
  shape_change_ = largest_change(state);
  // A period that was much too short for the mode it has shown says nothing.
  const bool settled = period_begin_ >= steady_after() && elapsed >= 0.5 * quarter &&
                       shape_change_ <= tolerances_.shape &&
                       force_residual(state) <= tolerances_.force;
  settled_periods_ = settled ? settled_periods_ + 1 : 0;
  open_period(state, std::min(quarter, 2 * elapsed));
}

template <int D>
Real Relaxation<D>::frequency(const State& state) const {
  Real stiffness = 0, mass = 0;
  for (Index A = 0; A < system_.size(); ++A) {
    const Lanes du = at(state.u, A) - at(period_u_, A);
    stiffness -= sum(du * (at(state.force, A) - at(period_force_, A)));
    mass += at(system_.mass, A) * sum(du * du);
  }
  return stiffness > 0 && mass > 0 ? std::sqrt(stiffness / mass) : 0;
}

template <int D>
Real Relaxation<D>::largest_change(const State& state) const {
  Real largest = 0;
  for (const Body<D>& body : system_.bodies) {
    NodalVectors du(static_cast<std::size_t>(body.size()));
    for (Index A = 0; A < body.size(); ++A)
      at(du, A) = at(state.u, body.first + A) - at(period_u_, body.first + A);
    Vec<D> low = Vec<D>::Constant(1e300), high = -low;
    Real change = 0;
    for (Index A = 0; A < body.size(); ++A) {
      const Vec<D>& X = at(body.particles.X(), A);
      low = low.cwiseMin(X);
      high = high.cwiseMax(X);
      const Lanes moved = value_at(body.at_particles, A, du.data());
      change = std::max(change, std::sqrt(sum(moved * moved)));
    }
    largest = std::max(largest, change / (high - low).maxCoeff());
  }
  return largest;
}

template <int D>
Real Relaxation<D>::force_residual(const State& state) const {
  const Real left = parallel_sum(system_.size(), 0.0, [&](Index A) {
    return std::sqrt(sum(at(state.force, A) * at(state.force, A)));
  });
  Real uncancelled = 0;
  for (const auto& term : system_.terms) uncancelled += term->uncancelled_force(state.motion());
  return uncancelled > 0 ? left / uncancelled : 0;
}

template <int D>
void Relaxation<D>::save(Snapshot& snapshot) const {
  add(snapshot, "relaxation/displacement", period_u_);
  add(snapshot, "relaxation/force", period_force_);
  const Real numbers[] = {mixing_, period_begin_, period_length_, shape_change_};
  snapshot.add_reals("relaxation/numbers", numbers);
  const std::int64_t counts[] = {downhill_steps_, settled_periods_};
  snapshot.add_integers("relaxation/counts", counts);
}

template <int D>
void Relaxation<D>::restore(const Snapshot& snapshot, const State& state) {
  begin(state);
  if (!snapshot.has("relaxation/numbers")) return;
  copy(snapshot, "relaxation/displacement", period_u_);
  copy(snapshot, "relaxation/force", period_force_);
  Real numbers[4];
  snapshot.copy_to("relaxation/numbers", numbers);
  mixing_ = numbers[0];
  period_begin_ = numbers[1];
  period_length_ = numbers[2];
  shape_change_ = numbers[3];
  const auto& counts = snapshot.integers("relaxation/counts");
  downhill_steps_ = counts.at(0);
  settled_periods_ = counts.at(1);
}

template class Relaxation<2>;
template class Relaxation<3>;

}  // namespace meniscus
