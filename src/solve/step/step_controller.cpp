// SPDX-License-Identifier: BSD-3-Clause
// Step control as the body deforms.
#include "solve/step/step_controller.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

// Steps to the first new estimate, when nothing is known yet of how fast the limit changes, and the
// fewest between later ones: an estimate of a limit that changes costs about as much as ten steps.
constexpr Real shortest_interval = 5;
// Part of the first stable step below which a run that chooses its steps warns, once.
constexpr Real much_shorter = 0.01;

/// What has become of the stable step of the beginning; `viscous`: viscosity limits steps.
std::string describe_shorter_step(std::string_view what, Real first, const StableStep& now,
                                  bool viscous) {
  std::string text =
      fmt::format("the stable time step has {} from {:.3g} to {:.3g}", what, first, now.dt);
  if (now.of_fields < 1.001 * now.dt) return text + " by a field that the bodies carry";
  if (viscous && now.viscosity > now.stiffness)
    text += ", by viscosity: viscosity = \"implicit\" in [time] takes that limit away";
  return text;
}

}  // namespace

template <int D>
void StepController<D>::begin(State& state) {
  if (estimator_.keeps_to_halo()) system_.enter_halo(state);
  // Where u = 0 the damping of coefficients is no smooth function of u, but for v = 0.
  State at_rest = state;
  std::fill(at_rest.v.begin(), at_rest.v.end(), Lanes::zero());
  stable_ = estimator_.estimate(at_rest);
  system_.complete(state);
  first_limit_ = stable_.dt;
  interval_ = shortest_interval;
  plan_next_check(state);
  choose_step();
}

template <int D>
void StepController<D>::plan_next_check(const State& state) {
  interval_ =
      std::min(std::max(interval_, shortest_interval), static_cast<Real>(choice_.check_every));
  last_check_ = state.step;
  next_check_ = state.step + static_cast<std::int64_t>(interval_);
  known_stiffness_ = state.demand.stiffness;
}

template <int D>
void StepController<D>::choose_step() {
  if (choice_.fixed && *choice_.fixed > stable_.dt)
    throw InputError(fmt::format(
        "{}: {:.6g} is above the stable step of the discretised system; allowed is <= {:.6g} (use "
        "{:.3g}, or leave the key out to have it chosen)",
        choice_.place, *choice_.fixed, stable_.dt, 0.9 * stable_.dt));
  step_ = choice_.fixed.value_or(choice_.safety * stable_.dt);
}

template <int D>
void StepController<D>::reconsider(State& state) {
  estimator_.keeps_to_halo() ? system_.enter_halo(state) : system_.complete(state);
  const Real before = stable_.dt;
  stable_ = estimator_.estimate_again(state, stable_);
  // So long that the limit changes by 2 % between estimates (with implicit viscosity, where it
  // falls with every step of a drop that spreads, by 4 %), and at most 1.5 times as long as before,
  // or twice where nothing has changed.
  const Real tolerated = choice_.implicit_viscosity ? 0.04 : 0.02,
             slowest = tolerated / (stable_.steady ? 2 : 1.5);
  interval_ *= tolerated / std::max(slowest, std::abs(std::log(stable_.dt / before)));
  plan_next_check(state);
  const auto describe = [&](std::string_view what) {
    return describe_shorter_step(what, first_limit_, stable_, !choice_.implicit_viscosity);
  };
  if (stable_.dt < 1e-6 * first_limit_) throw estimator_.failure(describe("collapsed"), state);
  if (choice_.fixed) {
    if (!warned_ && step_ > 0.98 * stable_.dt) {
      warning_ = fmt::format("step {}: time.step = {:.4g} has reached the stable step {:.4g}",
                             state.step, step_, stable_.dt);
      warned_ = true;
    }
    return;
  }
  if (!warned_ && stable_.dt < much_shorter * first_limit_) {
    warning_ = fmt::format("t = {:.6g}: {}", state.time,
                           estimator_.failure(describe("fallen"), state).what());
    warned_ = true;
  }
  // Small changes are left alone: every change of step disturbs the energy balance a little.
  const Real wanted = std::min(choice_.safety * stable_.dt, state.demand.longest);
  if (step_ > std::min(1.02 * wanted, stable_.dt) || step_ < 0.9 * wanted) step_ = wanted;
}

/// The longest step now: safety x the stable step with the stiffness that came since the estimate,
/// and what the terms allow.
template <int D>
Real StepController<D>::allowed_step(const State& state) const {
  const Real come = std::max(0.0, state.demand.stiffness - known_stiffness_);
  const ModeRates now{stable_.stiffness * stable_.stiffness + come, stable_.viscosity};
  const Real stable = come > 0 ? std::min(now.longest_step(), stable_.of_fields) : stable_.dt;
  return std::min(choice_.safety * stable, state.demand.longest);
}

/// Shortens the step where a term demands it. The demand bounds the stiffness from above, so before
/// a considerable change the operator itself is asked.
template <int D>
void StepController<D>::respect_demand(State& state) {
  constexpr Real tolerated = 1.05, margin = 0.9;
  if (choice_.fixed || step_ <= tolerated * allowed_step(state)) return;
  if (state.step >= last_check_ + static_cast<std::int64_t>(shortest_interval)) reconsider(state);
  const Real allowed = allowed_step(state);
  if (step_ > tolerated * allowed) step_ = margin * allowed;
}

template <int D>
Real StepController<D>::next(State& state, Real end, Real accurate) {
  if (state.step >= next_check_) reconsider(state);
  respect_demand(state);
  // What viscosity stops within one of its steps, central differences resolve anyway; not so the
  // forces of a field that starts away from its rest, as a director does.
  const Real least_share = choice_.implicit_viscosity ? 1e-3 : state.fields.empty() ? 0.1 : 0.03;
  const Real dt = choice_.fixed ? step_ : std::min(step_, std::max(accurate, least_share * step_));
  const Real left = end - state.time;
  if (left <= dt * (1 + 1e-9)) return left;
  if (left < 2 * dt) return left / 2;
  return dt;
}

template <int D>
void StepController<D>::archive(const Archive& a) {
  estimator_.archive(a);
  stable_.archive(a.in("stable"));
  a("step", step_, dimension::time);
  a("first_limit", first_limit_, dimension::time);
  a("interval", interval_);
  a("next_check", next_check_);
  a("last_check", last_check_);
  a("known_stiffness", known_stiffness_, {0, -2, 0});
  a("warned", warned_);
  std::optional<Real> fixed = choice_.fixed;
  Real safety = choice_.safety;
  a("fixed", fixed, dimension::time);
  a("safety", safety);
  // What was fixed may have come to be above the limit since it was chosen.
  require_saved(step_ > 0 && step_ <= fixed.value_or(stable_.dt), a, "step_control/step");
  require_saved(first_limit_ > 0, a, "step_control/first_limit");
  require_saved(interval_ > 0 && interval_ <= 1e9 && last_check_ >= 0 &&
                    next_check_ >= last_check_ && next_check_ <= last_check_ + 1e9,
                a, "step_control/interval");
  if (fixed != choice_.fixed || safety != choice_.safety) choose_step();
}

template class StepController<2>;
template class StepController<3>;

}  // namespace meniscus
