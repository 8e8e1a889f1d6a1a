// SPDX-License-Identifier: BSD-3-Clause
// The limit of the time step that resolves the exchange of energy.
#include "solve/step/energy_resolution.hpp"

#include "meniscus/error.hpp"
#include "parallel/parallel.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Largest error of the energy balance, as a fraction of the energy in motion. With 5e-3, no hard
/// case of a default scene exceeds 1e-2 (study hard). A director that starts away from its discrete
/// rest has large forces for a few steps, before they move anything; with 2e-4 the balance stays
/// within 1e-4 of the exchanged energy.
template <int D>
Real eta(const System<D>& system) {
  return system.carried.empty() ? 5e-3 : 2e-4;
}

/// The sums of m v^2/2, f^2/m and f.v.
template <int D>
Eigen::Vector3d products(const System<D>& system, const NodalVectors& v, const NodalVectors& f,
                         const std::vector<Real>& mass) {
  return system.sum_over_particles(Eigen::Vector3d(Eigen::Vector3d::Zero()), [&](Index A) {
    const Real m = at(mass, A);
    return Eigen::Vector3d(m / 2 * sum(at(v, A) * at(v, A)), sum(at(f, A) * at(f, A)) / m,
                           sum(at(f, A) * at(v, A)));
  });
}

}  // namespace

template <int D>
typename EnergyResolution<D>::Sums EnergyResolution<D>::sums(const System<D>& system,
                                                             const State& state) {
  Eigen::Vector3d all = products(system, state.v, state.force, system.mass);
  for (const Unknown& field : state.fields)
    if (field.spec.evolution == Evolution::inertial)
      all += products(system, field.rate, field.f, field.capacity);
  return {all[0], all[1], all[2], state.time};
}

template <int D>
Real EnergyResolution<D>::longest_step(const System<D>& system, const State& state) {
  const Sums all = judged_.time == state.time ? judged_ : sums(system, state);
  energy_ =
      std::max(energy_, all.kinetic + state.books.dissipated + std::abs(state.books.external_work));
  if (time_ < 0) {
    remember(all.S, all.power, state.time);
    return 0;
  }
  // S + v.Kv is constant in linear motion. On average S is half of it, and S never exceeds it.
  const Real S = std::max(all.S, exchanged(all.S, all.power, state.time) / 2);
  remember(all.S, all.power, state.time);
  hold(S > 0 ? std::sqrt(8 * eta(system) * energy_ / S) : unbounded, state.step);
  return held_;
}

template <int D>
void EnergyResolution<D>::judge(const System<D>& system, const State& state, Real dt) {
  constexpr Real considerably = 1.5;
  judged_ = sums(system, state);
  const Sums& all = judged_;
  // A load that suddenly sets bodies in motion cannot be resolved by any step.
  const bool set_in_motion = all.kinetic > 4 * energy_;
  const Real disturbance = dt * dt / 8 * std::abs(all.S - S_);
  if (time_ < 0 || set_in_motion || disturbance <= considerably * eta(system) * energy_) return;
  StepFailure failure;
  failure.cause =
      fmt::format("the step disturbs the balance of energy by {:.2g} of the energy in motion",
                  disturbance / energy_);
  failure.of_step = true;
  throw StepError(failure);
}

template <int D>
void EnergyResolution<D>::remember(Real S, Real power, Real time) {
  S_ = S;
  power_ = power;
  time_ = time;
}

/// S + v.Kv in the middle of the last step, from d(f.v)/dt = S - v.Kv.
template <int D>
Real EnergyResolution<D>::exchanged(Real S, Real power, Real time) const {
  return time > time_ ? S + S_ - (power - power_) / (time - time_) : 0;
}

/// Limits the step. Each change of the step disturbs the balance a little, and following each
/// oscillation would make it drift. Therefore a shorter step is chosen with a margin, and a
/// considerably longer step only after an interval in which it was allowed throughout. These
/// intervals grow with the run.
template <int D>
void EnergyResolution<D>::hold(Real allowed, std::int64_t step) {
  constexpr Real margin = 0.8, considerable = 1.3;
  constexpr std::int64_t shortest_interval = 5, share_of_run = 4;
  least_ = std::min(least_, allowed);
  if (allowed < held_) held_ = margin * allowed;
  if (step < interval_end_) return;
  if (margin * least_ > considerable * held_) held_ = margin * least_;
  least_ = unbounded;
  interval_end_ = step + std::max(shortest_interval, step / share_of_run);
}

template <int D>
void EnergyResolution<D>::archive(const Archive& a) {
  if (a.is_reading()) judged_ = {};
  a("S", S_, of_sum({2, -4, 1}, D));
  a("power", power_, of_sum(dimension::power, D));
  a("time", time_, dimension::time);
  a("energy", energy_, of_sum(dimension::energy, D));
  a("held", held_, dimension::time);
  a("least", least_, dimension::time);
  a("window_end", interval_end_);
  require_saved(S_ >= 0 && energy_ >= 0 && held_ >= 0 && least_ >= 0 && interval_end_ >= 0, a,
                "energy_resolution");
}

template class EnergyResolution<2>;
template class EnergyResolution<3>;

}  // namespace meniscus
