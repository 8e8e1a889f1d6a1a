// SPDX-License-Identifier: BSD-3-Clause
// Implicit Euler steps for fluids, and the detection of rest.
#include "solve/newton/flow_to_rest.hpp"

#include "parallel/nodal_algebra.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Tolerance of Newton's method: the energy that the next iteration would release, as a fraction of
/// the energy scale. The next time step corrects the remaining error.
constexpr Real tolerance_of_flow = 1e-6;

}  // namespace

template <int D>
FlowToRest<D>::FlowToRest(System<D>& system, const StepperChoice& choice)
    : system_(system),
      choice_(choice),
      fluids_(system, choice.fluid),
      euler_(system),
      method_(system, &euler_, tolerance_of_flow),
      work_(system) {
  still_.assign(static_cast<std::size_t>(system.size()), Lanes::zero());
  middle_force_ = still_;
  if (system.constraints) lambda_.resize(static_cast<std::size_t>(system.constraints->rows()));
}

template <int D>
void FlowToRest<D>::begin(const State& state) {
  tau_ = power_ = released_ = all_released_ = moment_of_release_ = 0;
  began_ = state.time;
  has_static_forces_ = arrived_ = false;
}

template <int D>
void FlowToRest<D>::settle(State& state) {
  stop_motion(system_, state);
}

template <int D>
Real FlowToRest<D>::longest_step(const State& state) {
  constexpr Real part_of_clock = 0.1;
  const Real steady = system_.steady_after();
  const bool changing = steady > state.time;
  if (tau_ == 0)
    tau_ = std::min(choice_.load_step(), part_of_clock * fluids_.clock_of(stored_size(state)));
  const Real goal = changing ? std::min(steady, choice_.end) : choice_.end,
             step = changing ? std::min(choice_.load_step(), tau_) : tau_;
  return reaches(state.time, step, goal) ? goal - state.time : step;
}

template <int D>
Real FlowToRest<D>::stored_size(const State& state) const {
  Real size = 0;
  for (const auto& term : system_.terms)
    size += std::abs(term->stored_energy(state.motion()).value_or(0));
  return size;
}

/// Energy scale of the flow. It has a lower bound for flows that start near rest.
template <int D>
Real FlowToRest<D>::scale_of_flow(Real stored) const {
  constexpr Real least_share = 1e-4;
  return std::max(all_released_, least_share * stored);
}

template <int D>
void FlowToRest<D>::step(State& state, Real dt) {
  constexpr Real bearable = 1e-3;    // error of the balance / energy exchanged
  constexpr Real idle_share = 1e-3;  // fraction of the energy that may remain at rest
  const State before = state;
  const Real end = state.time + dt;
  Real released = 0, piece = dt;
  bool easy = true;
  try {
    if (!has_static_forces_) {
      settle(state);
      system_.compute_forces(state.motion(), state.forces());
      has_static_forces_ = true;
    }
    while (state.time < end) {
      const Real time = reaches(state.time, piece, end) ? end : state.time + piece;
      euler_.begin(state.time, state.u, time - state.time);
      method_.prepare();
      const auto solution =
          method_.solve({time, state.u, nullptr,
                         idle_share * choice_.force_tolerance * scale_of_flow(stored_size(state))});
      const bool failed = !solution.failure.empty();
      if (failed && piece <= least_piece * dt)
        throw SolveError(fmt::format("no step of implicit Euler is found to t = {:.6g}: {}{}", time,
                                     solution.failure, unbalanced(system_, state, time)));
      if (failed) {
        piece /= 2;
        easy = false;
        continue;
      }
      State next = state;
      const auto exchange = work_.move(next, time, solution.u);
      const Real lost = work_of_forces(state, next);
      const Real unexplained = std::abs(exchange.released() - lost);
      if (unexplained > bearable * std::max(exchange.size(), all_released_) &&
          piece > least_piece * dt) {
        piece /= 2;
        continue;
      }
      easy &= !solution.hard();
      next.books.dissipated += lost;
      released += lost;
      state = std::move(next);
      system_.commit(state.motion());
    }
  } catch (...) {
    state = before;
    throw;
  }
  state.time = end;
  ++state.step;
  const bool whole_step = dt >= tau_ * (1 - 1e-9);
  if (piece < dt) tau_ = piece;
  judge_rest(state, dt, released, whole_step && easy);
}

/// Work of the static forces on a straight line between two states, by Simpson's rule.
template <int D>
Real FlowToRest<D>::work_of_forces(const State& from, const State& to) {
  NodalVectors way = to.u, middle = from.u;
  add(way, -1, from.u);
  add(middle, 0.5, way);
  const Real ends = dot(from.force, way) + dot(to.force, way);
  const Report report = system_.add_up({(from.time + to.time) / 2, middle, still_}, middle_force_);
  if (report.failure) return ends / 2;
  if (system_.constraints) system_.constraints->balance(middle_force_, lambda_);
  return (ends + 4 * dot(middle_force_, way)) / 6;
}

/// Estimates the energy that is still to be released, relative to the energy scale, and sets
/// arrived_ if it is within the tolerance. If a step releases a small part of the energy released
/// by the last one, the next steps are assumed to do the same. Slow modes of the coefficients
/// hardly move positions; they are judged by the energy that they release within the time that the
/// flow took.
template <int D>
void FlowToRest<D>::judge_rest(const State& state, Real dt, Real released, bool whole_step) {
  constexpr Real slow = 1.0 / 30, fast = 0.5;
  const Real steady = system_.steady_after(), power = std::abs(released) / dt;
  arrived_ = state.time >= choice_.end;
  left_ = 1;
  if (state.time <= steady) {
    if (whole_step) tau_ = std::min(2 * tau_, choice_.load_step());
    return;
  }
  all_released_ += power * dt;
  moment_of_release_ += power * dt * (state.time - dt / 2 - std::max(steady, began_));
  const Real stored = stored_size(state), scale = scale_of_flow(stored),
             time = std::max(fluids_.clock_of(stored), moment_of_release_ / scale);
  const bool falling = power <= power_;
  if (scale > 0 && falling) left_ = power * time / scale;
  const Real share = released_ > 0 ? power * dt / released_ : 1;
  if (share < fast) left_ = std::min(left_, power * dt * share / (1 - share) / scale);
  power_ = power;
  if (whole_step) {
    released_ = power * dt;
    if (share > slow) tau_ *= 2;
  }
  arrived_ = left_ <= choice_.force_tolerance;
}

template <int D>
std::vector<Residual> FlowToRest<D>::residuals(const State&) const {
  return {{"energy left", left_, choice_.force_tolerance},
          {"stability", method_.stability(), std::nullopt},
          {"jumps", 0, std::nullopt}};
}

template <int D>
std::string FlowToRest<D>::obstacle(const State& state) const {
  return net_forces(system_, state);
}

template <int D>
void FlowToRest<D>::archive(const Archive& a, const State&) {
  method_.archive(a);
  a("left_to_release", left_);
  a("step_of_flow", tau_, dimension::time);
  a("power", power_, of_sum(dimension::power, D));
  a("released", released_, of_sum(dimension::energy, D));
  a("all_released", all_released_, of_sum(dimension::energy, D));
  a("moment_of_release", moment_of_release_);
  a("began", began_, dimension::time);
  a("has_static_forces", has_static_forces_);
  a("arrived", arrived_);
  require_saved(tau_ >= 0, a, "step_of_flow");
}

template class FlowToRest<2>;
template class FlowToRest<3>;

}  // namespace meniscus
