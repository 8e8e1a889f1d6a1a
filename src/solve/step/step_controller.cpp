// SPDX-License-Identifier: BSD-3-Clause
// Control of the step while bodies deform.
#include "solve/step/step_controller.hpp"

#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meniscus {
namespace {

// Steps to the first new estimate of the limit, when its rate of change is still unknown, and the
// least number of steps between estimates. An estimate costs about as much as ten steps while the
// limit changes.
constexpr Real shortest_interval = 5;
// If the program chooses the step, it warns once when the step falls below this fraction of the
// first stable step.
constexpr Real much_shorter = 0.01;

/// Describes how the stable step has changed since the beginning. `viscous`: viscosity may limit
/// the step.
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
  system_.follow(state);
  // At u = 0 the damping of coefficients is not a smooth function of u, unless v = 0.
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
  system_.follow(state);
  const Real before = stable_.dt;
  stable_ = estimator_.estimate_again(state, stable_);
  // Choose the interval so that the limit changes by 2 % between estimates; 4 % with implicit
  // viscosity, where the limit falls with each step of a spreading drop. It grows at most by the
  // factor 1.5, or 2 if the limit is steady.
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
  // Small changes are not made, because each change of step disturbs the energy balance a little.
  const Real wanted = std::min(choice_.safety * stable_.dt, state.demand.longest);
  if (step_ < 0.9 * wanted) rejected_.reset();
  if (step_ > std::min(1.02 * wanted, stable_.dt) || step_ < 0.9 * wanted) step_ = wanted;
}

/// The longest step allowed now. The stiffness that was added since the last estimate shortens the
/// stable step; the result is multiplied by the safety factor and limited by the demands of the
/// terms.
template <int D>
Real StepController<D>::allowed_step(const State& state) const {
  const Real come = std::max(0.0, state.demand.stiffness - known_stiffness_);
  const ModeRates now{stable_.stiffness * stable_.stiffness + come, stable_.viscosity};
  const Real stable = come > 0 ? std::min(now.longest_step(), stable_.of_fields) : stable_.dt;
  return std::min(choice_.safety * stable, state.demand.longest);
}

/// Shortens the step if a term demands it. The demand is an upper bound of the stiffness; before a
/// considerable change, the limit is estimated again.
template <int D>
void StepController<D>::respect_demand(State& state) {
  constexpr Real tolerated = 1.05, margin = 0.9;
  if (choice_.fixed || step_ <= tolerated * allowed_step(state)) return;
  if (state.step >= last_check_ + static_cast<std::int64_t>(shortest_interval)) reconsider(state);
  const Real allowed = allowed_step(state);
  if (step_ > tolerated * allowed) step_ = margin * allowed;
}

/// The error of a run whose steps `dt` have become so short that the time does not grow. It names
/// the cause of the last rejected step, or the fastest particle.
template <int D>
StepError StepController<D>::time_stands_still(const State& state, Real dt) const {
  const std::string cause = fmt::format("steps of {:.3g} do not change the time any more", dt);
  if (rejected_) {
    StepFailure failure = *rejected_;
    failure.cause =
        fmt::format("{}, for the step is halved again and again: {}", cause, failure.cause);
    failure.halvings = 0;
    return StepError(failure);
  }
  struct Fastest {
    Real square;
    Index particle;
    Fastest operator+(const Fastest& b) const { return b.square > square ? b : *this; }
  };
  const Fastest all = system_.sum_over_particles(Fastest{-1, 0}, [&](Index A) {
    return Fastest{sum(at(state.v, A) * at(state.v, A)), A};
  });
  return StepError(system_.located(
      {all.particle, cause +
                         ": surfaces come nearer faster than their contact can stop them; slower "
                         "motion or weaker loads are needed"},
      state.motion()));
}

template <int D>
Real StepController<D>::next(State& state, Real end, Real accurate) {
  if (state.step >= next_check_) reconsider(state);
  respect_demand(state);
  // Motion that viscosity stops within one viscous step is resolved by central differences in any
  // case. The large forces of a field that starts away from its rest, such as a director, are not.
  const Real least_share = choice_.implicit_viscosity ? 1e-3 : state.fields.empty() ? 0.1 : 0.03;
  const Real dt = choice_.fixed ? step_ : std::min(step_, std::max(accurate, least_share * step_));
  // Steps that each close a share of a gap, or that are halved again and again, never end.
  if (!(dt > 4 * std::numeric_limits<Real>::epsilon() * state.time))
    throw time_stands_still(state, dt);
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
  // A fixed step may have become longer than the limit since it was chosen.
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
