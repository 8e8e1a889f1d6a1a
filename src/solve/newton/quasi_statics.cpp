// SPDX-License-Identifier: BSD-3-Clause
// Load steps, which are divided into pieces at jumps.
#include "solve/newton/quasi_statics.hpp"

#include "parallel/nodal_algebra.hpp"
#include "solve/step/rest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace meniscus {
namespace {

/// Tolerance at rest: the energy that the next iteration would release, relative to the largest
/// such energy of the step.
constexpr Real tolerance_of_rest = 1e-9;
/// Energy lost by a jump that is reported, as a fraction of the energy that a piece of a step
/// exchanges.
constexpr Real noticeable = 0.05;
/// Length of the pieces in which a jump is resolved, as a fraction of the load step.
constexpr Real piece_of_jump = 1.0 / 8;

}  // namespace

template <int D>
QuasiStatics<D>::QuasiStatics(System<D>& system, const StepperChoice& choice)
    : system_(system),
      choice_(choice),
      method_(system, nullptr, tolerance_of_rest),
      work_(system) {}

template <int D>
void QuasiStatics<D>::begin(const State&) {
  work_.forget();
  at_equilibrium_ = arrived_ = false;
}

template <int D>
Real QuasiStatics<D>::longest_step(const State& state) {
  const Real steady = system_.steady_after();
  const Real goal = steady > state.time ? std::min(steady, choice_.end) : choice_.end;
  const Real step = choice_.load_step();
  return reaches(state.time, step, goal) ? goal - state.time : step;
}

template <int D>
void QuasiStatics<D>::step(State& state, Real dt) {
  const State before = state;
  const std::size_t noted = notes_.size();
  const Real end = state.time + dt;
  try {
    settle(state);
    for (Real piece = dt; state.time < end;) {
      const Real time = reaches(state.time, piece, end) ? end : state.time + piece;
      const auto solution = solve(state, time);
      const bool failed = !solution.failure.empty();
      if (failed && piece <= least_piece * dt)
        throw SolveError(fmt::format("no equilibrium is found at t = {:.6g}: {}{}", time,
                                     solution.failure, unbalanced(system_, state, time)));
      if (failed) {
        piece /= 2;
        continue;
      }
      State next = state;
      const auto exchange = work_.move(next, time, solution.u);
      const bool far = is_far(state, time, solution);
      const Real apart = far ? exchange.released() / exchange.size() : 0;
      const bool jump = apart > noticeable;
      // With factors, an equilibrium beyond a fork is not doubted unless work is missing.
      const bool unclear =
          jump || (solution.mixed ? solution.bent && apart < -noticeable : solution.hard());
      if (unclear && piece > piece_of_jump * dt * (1 + 1e-9)) {
        piece /= 2;
        continue;
      }
      if (jump)
        book_jump(next, state.time, exchange.released());
      else
        work_.book_bend(state, next);
      if (solution.saddles > 0) note_saddle(time);
      if (solution.flat) note_flat(time);
      work_.go_on(jump);
      state = std::move(next);
      system_.commit(state.motion());
      piece = std::min(2 * piece, dt);
    }
  } catch (...) {
    state = before;
    notes_.resize(noted);
    throw;
  }
  state.time = end;
  ++state.step;
  arrived_ = end >= std::min(system_.steady_after(), choice_.end);
}

/// Finds the equilibrium, starting from the last displacement, continued with the rate of the last
/// step if that is known.
template <int D>
typename NewtonMethod<D>::Solution QuasiStatics<D>::solve(const State& state, Real time) {
  const auto& last = work_.last();
  if (!(last.dt > 0)) return method_.solve({time, state.u, nullptr, 0, state.time});
  NodalVectors expected = state.u;
  add(expected, (time - state.time) / last.dt, last.du);
  return method_.solve({time, state.u, &expected, 0, state.time});
}

/// True if the solution is far from the prediction of the last step, or was found by a winding
/// path.
template <int D>
bool QuasiStatics<D>::is_far(const State& state, Real time,
                             const typename NewtonMethod<D>::Solution& solution) const {
  const auto& last = work_.last();
  if (solution.winding() || last.dt == 0) return solution.winding();
  const Real steps = (time - state.time) / last.dt;
  NodalVectors off = solution.u;
  add(off, -1, state.u);
  add(off, -steps, last.du);
  return largest(off) > steps * largest(last.du);
}

template <int D>
void QuasiStatics<D>::settle(State& state) {
  stop_motion(system_, state);
  method_.prepare();
  if (at_equilibrium_) return;
  const auto solution = solve(state, state.time);
  if (!solution.failure.empty())
    throw SolveError(fmt::format("no equilibrium is found at the beginning: {}{}", solution.failure,
                                 unbalanced(system_, state, state.time)));
  if (solution.saddles > 0) note_saddle(state.time);
  state.books.dissipated += work_.move(state, state.time, solution.u).released();
  system_.commit(state.motion());
  at_equilibrium_ = true;
}

template <int D>
void QuasiStatics<D>::book_jump(State& state, Real since, Real released) {
  state.books.dissipated += released;
  ++jumps_;
  notes_.push_back(
      fmt::format("jump between t = {:.6g} and {:.6g}: {:.4g} of energy released, booked as "
                  "dissipated",
                  since, state.time, released));
}

template <int D>
void QuasiStatics<D>::note_saddle(Real time) {
  notes_.push_back(
      fmt::format("t = {:.6g}: an equilibrium was found that is not stable; it was left for one of "
                  "less energy, beside which there may be others that are as near",
                  time));
}

template <int D>
void QuasiStatics<D>::note_flat(Real time) {
  notes_.push_back(
      fmt::format("t = {:.6g}: forces of {:.2g} of loads and reactions are left, along a motion "
                  "that hardly changes the energy; hold the bodies against it, or disturb their "
                  "symmetry",
                  time, method_.left()));
}

template <int D>
std::vector<Residual> QuasiStatics<D>::residuals(const State&) const {
  return {{"energy left", method_.left(), tolerance_of_rest},
          {"stability", method_.stability(), std::nullopt},
          {"jumps", static_cast<Real>(jumps_), std::nullopt}};
}

template <int D>
std::string QuasiStatics<D>::obstacle(const State& state) const {
  return net_forces(system_, state);
}

template <int D>
void QuasiStatics<D>::archive(const Archive& a, const State&) {
  work_.archive(a);
  method_.archive(a);
  a("jumps", jumps_);
  a("at_equilibrium", at_equilibrium_);
  a("arrived", arrived_);
  require_saved(jumps_ >= 0, a, "jumps");
}

template class QuasiStatics<2>;
template class QuasiStatics<3>;

}  // namespace meniscus
