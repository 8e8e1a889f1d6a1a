// SPDX-License-Identifier: BSD-3-Clause
// Truncated Newton with conjugate gradients, load step by load step.
#include "meniscus/solve/quasi_statics.hpp"

#include "meniscus/core/dense.hpp"
#include "meniscus/core/parallel.hpp"
#include "meniscus/solve/rest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meniscus {
namespace {

/// Of the energy that the next step would release, relative to the largest that one has; in a step
/// of implicit Euler, where what is missed is left to the next one.
constexpr Real tolerance = 1e-9, tolerance_of_flow = 1e-6;
/// Of that, where another iteration would be idle.
constexpr Real polished = 1e-3;
constexpr int most_iterations = 60, most_tangents = 400;
/// Load steps are cut into pieces down to this part of them.
constexpr Real least_piece = 1.0 / 256;
/// Of the energy that a piece of a step exchanges: what is lost beyond the work by a jump.
constexpr Real noticeable = 0.05;
/// What jumps is looked at in pieces of this part.
constexpr Real piece_of_jump = 1.0 / 8;

/// x += a w
void add(NodalVectors& x, Real a, const NodalVectors& w) {
  for_chunks(static_cast<Index>(x.size()), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(x, A) += a * at(w, A);
  });
}

}  // namespace

template <int D>
QuasiStatics<D>::QuasiStatics(System<D>& system, const StepperChoice& choice)
    : system_(system), choice_(choice), fluids_(system, choice.fluid), spacing_(unbounded) {
  const auto n = static_cast<std::size_t>(system.size());
  still_.assign(n, Lanes::zero());
  last_work_.resize(1);
  if (system.constraints) {
    lambda_.resize(static_cast<std::size_t>(system.constraints->rows()));
    last_lambda_ = lambda_;
    last_work_.resize(system.constraints->all().size() + 1);
  }
  r_ = trial_r_ = s_ = g_ = z_ = p_ = q_ = scaled_ = last_du_ = still_;
  for (const Body<D>& body : system.bodies)
    for (Index A = 0; A < body.size(); ++A)
      spacing_ = std::min(
          spacing_, body.particles.search().distance_of_nearest(at(body.particles.X(), A), 2));
  if (fluids_.any()) euler_.emplace(system);
  tolerance_ = euler_ ? tolerance_of_flow : tolerance;
}

template <int D>
void QuasiStatics<D>::begin(const State& state) {
  last_dt_ = tau_ = power_ = released_ = all_released_ = moment_of_release_ = 0;
  began_ = state.time;
  at_equilibrium_ = arrived_ = false;
}

template <int D>
Real QuasiStatics<D>::longest_step(const State& state) {
  const Real steady = system_.steady_after();
  const bool changing = steady > state.time;
  const Real goal = changing ? std::min(steady, choice_.end) : choice_.end;
  Real step = load_step();
  if (euler_) {
    constexpr Real part_of_clock = 0.1;
    if (tau_ == 0) tau_ = std::min(step, part_of_clock * fluids_.clock_of(stored_size(state)));
    step = changing ? std::min(step, tau_) : tau_;
  }
  const Real left = goal - state.time;
  return left <= step * (1 + 1e-9) ? left : step;
}

template <int D>
Real QuasiStatics<D>::dot(const NodalVectors& a, const NodalVectors& b) const {
  return parallel_sum(system_.size(), 0.0, [&](Index A) { return sum(at(a, A) * at(b, A)); });
}

template <int D>
Real QuasiStatics<D>::largest(const NodalVectors& w) const {
  Real square = 0;
  for (const NodalVector& x : w) square = std::max(square, sum(x * x));
  return std::sqrt(square);
}

template <int D>
void QuasiStatics<D>::step(State& state, Real dt) {
  if (euler_) return flow(state, dt);
  const State before = state;
  const Real end = state.time + dt;
  try {
    settle(state);
    for (Real piece = dt; state.time < end;) {
      const bool last = end - state.time <= piece * (1 + 1e-9);
      const Real time = last ? end : state.time + piece;
      const Solution solution = solve(state, time);
      const bool failed = !solution.failure.empty();
      if (failed && piece <= least_piece * dt)
        throw SolveError(fmt::format("no equilibrium is found at t = {:.6g}: {}{}", time,
                                     solution.failure, unbalanced(state, time)));
      if (failed) {
        piece /= 2;
        continue;
      }
      State next = state;
      const Exchange exchange = move(next, time, solution.point.u);
      const bool jump = solution.far && exchange.released() > noticeable * exchange.size();
      if ((jump || solution.hard) && piece > piece_of_jump * dt * (1 + 1e-9)) {
        piece /= 2;
        continue;
      }
      if (!jump && last_dt_ > 0) book_bend(state, next);
      last_dt_ = jump ? 0 : time - state.time;
      last_du_ = scaled_;
      last_work_ = work_;
      last_lambda_ = state.reactions.force;
      if (jump) book_jump(next, state.time, exchange.released());
      state = std::move(next);
      system_.commit(state.motion());
      piece = std::min(2 * piece, dt);
    }
  } catch (...) {
    state = before;
    throw;
  }
  state.time = end;
  ++state.step;
  arrived_ = end >= std::min(system_.steady_after(), choice_.end);
}

template <int D>
Real QuasiStatics<D>::load_step() const {
  constexpr int steps_of_run = 20;
  return choice_.step.value_or(choice_.end / steps_of_run);
}

template <int D>
Real QuasiStatics<D>::stored_size(const State& state) const {
  Real size = 0;
  for (const auto& term : system_.terms)
    size += std::abs(term->stored_energy(state.motion()).value_or(0));
  return size;
}

/// A flow that begins near its rest has this energy at least.
template <int D>
Real QuasiStatics<D>::scale_of_flow(Real stored) const {
  constexpr Real least_share = 1e-4;
  return std::max(all_released_, least_share * stored);
}

/// Of the static forces on the straight way from one state to another, by Simpson's rule.
template <int D>
Real QuasiStatics<D>::work_of_forces(const State& from, const State& to) {
  NodalVectors way(from.u.size()), middle = way;
  for (std::size_t A = 0; A < way.size(); ++A) {
    way[A] = to.u[A] - from.u[A];
    middle[A] = from.u[A] + 0.5 * way[A];
  }
  const Real ends = dot(from.force, way) + dot(to.force, way);
  const Report report = system_.add_up({(from.time + to.time) / 2, middle, still_}, r_);
  if (report.failure) return ends / 2;
  if (system_.constraints) {
    reactions(r_, lambda_);
    system_.constraints->add_transposed(lambda_, 1, r_);
  }
  return (ends + 4 * dot(r_, way)) / 6;
}

/// A step of implicit Euler, in pieces where it is too long to be solved for. What static forces do
/// on the way is dissipated.
template <int D>
void QuasiStatics<D>::flow(State& state, Real dt) {
  constexpr Real bearable = 1e-3;  // of the energy exchanged: what is missed of its balance
  const State before = state;
  const Real end = state.time + dt;
  Real released = 0, piece = dt;
  bool easy = true;
  try {
    if (!at_equilibrium_) {  // forces of no motion
      settle(state);
      system_.compute_forces(state.motion(), state.forces());
      at_equilibrium_ = true;
    }
    while (state.time < end) {
      const bool last = end - state.time <= piece * (1 + 1e-9);
      const Real time = last ? end : state.time + piece;
      euler_->begin(state.time, state.u, time - state.time);
      if (preconditioner_)
        preconditioner_->renew(system_, &*euler_);
      else
        preconditioner_.emplace(system_, &*euler_);
      energy_scale_ = 0;
      const Solution solution = solve(state, time);
      const bool failed = !solution.failure.empty();
      if (failed && piece <= least_piece * dt)
        throw SolveError(fmt::format("no step of implicit Euler is found to t = {:.6g}: {}{}", time,
                                     solution.failure, unbalanced(state, time)));
      if (failed) {
        piece /= 2;
        easy = false;
        continue;
      }
      State next = state;
      const Exchange exchange = move(next, time, solution.point.u);
      const Real lost = work_of_forces(state, next);
      const Real unexplained = std::abs(exchange.released() - lost);
      if (unexplained > bearable * std::max(exchange.size(), all_released_) &&
          piece > least_piece * dt) {
        piece /= 2;
        continue;
      }
      easy &= !solution.hard;
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

/// Steps that release a small part of what the one before has leave as small a part of theirs.
/// Coefficients have slow modes that hardly move places, and are judged by what they release within
/// the time that the flow took.
template <int D>
void QuasiStatics<D>::judge_rest(const State& state, Real dt, Real released, bool whole_step) {
  constexpr Real slow = 1.0 / 30, fast = 0.5;
  const Real steady = system_.steady_after(), power = std::abs(released) / dt;
  arrived_ = state.time >= choice_.end;
  left_ = 1;
  if (state.time <= steady) {
    if (whole_step) tau_ = std::min(2 * tau_, load_step());
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

/// What no body holds against, for a message.
template <int D>
std::string QuasiStatics<D>::unbalanced(State& state, Real time) {
  system_.add_up({time, state.u, still_}, state.force);
  const std::string net = net_forces(system_, state);
  return net.empty() ? "" : "; " + net + ", which nothing balances";
}

template <int D>
void QuasiStatics<D>::stop_motion(State& state) {
  state.books.dissipated += parallel_sum(system_.size(), 0.0, [&](Index A) {
    return 0.5 * at(system_.mass, A) * sum(at(state.v, A) * at(state.v, A));
  });
  state.v = still_;
  state.books.begin({}, 0);
}

/// Whether nothing holds a body, or all of them, in a direction in which something pulls: in words.
template <int D>
std::string QuasiStatics<D>::pulled(Real time, const NodalVectors& u) {
  constexpr Real round_off = 1e-9;
  const auto in_direction = [&](const Body<D>* only, int i) {
    for (const Body<D>& body : system_.bodies)
      for (NodalVector& w : body.part(std::span<NodalVector>(p_))) {
        w = Lanes::zero();
        if (!only || only == &body) w.set(i, 1);
      }
    if (system_.constraints) {
      system_.constraints->apply(p_, lambda_);
      for (const Real held : lambda_)
        if (std::abs(held) > round_off) return false;
    }
    const Real pull = std::abs(dot(p_, r_));
    const Real sizes = parallel_sum(system_.size(), 0.0,
                                    [&](Index A) { return std::abs(sum(at(p_, A) * at(r_, A))); });
    if (pull <= 0.1 * sizes) return false;
    apply(time, u);
    return largest(q_) <= round_off * preconditioner_->elements().stiffness_scale();
  };
  for (int i = 0; i < D; ++i) {
    if (in_direction(nullptr, i)) return "nothing holds the bodies in the direction of the forces";
    for (const Body<D>& body : system_.bodies)
      if (in_direction(&body, i))
        return fmt::format("nothing holds body '{}' in the direction of its forces", body.name);
  }
  return "";
}

/// The displacement before, continued with the rate of the last step if forces can be computed
/// there.
template <int D>
bool QuasiStatics<D>::begin_at(const State& state, Real time, Point& point) {
  point.u = state.u;
  if (last_dt_ > 0) {
    add(point.u, (time - state.time) / last_dt_, last_du_);
    preconditioner_->meet(time, point.u);
    if (evaluate(time, point, r_)) return true;
    point.u = state.u;
  }
  preconditioner_->meet(time, point.u);
  return evaluate(time, point, r_);
}

template <int D>
bool QuasiStatics<D>::evaluate(Real time, Point& point, NodalVectors& force) {
  const Motion motion{time, point.u, still_};
  const Report report = system_.add_up(motion, force);
  if (report.failure) broken_ = system_.located(*report.failure, motion).text();
  if (report.failure || !std::isfinite(dot(force, force))) return false;
  point.potential = 0;
  for (auto& term : system_.terms) point.potential += term->potential(motion).value();
  if (euler_) point.potential += euler_->add_force(point.u, force);
  if (system_.constraints) {
    reactions(force, lambda_);
    system_.constraints->add_transposed(lambda_, 1, force);
  }
  free_.remove_from(force);
  return true;
}

template <int D>
Real QuasiStatics<D>::apply(Real time, const NodalVectors& u) {
  // Terms without an exact tangent take differences over a part of the change.
  const Real scale = spacing_ / largest(p_);
  for_chunks(system_.size(), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(scaled_, A) = scale * at(p_, A);
      at(q_, A) = Lanes::zero();
    }
  });
  for (auto& term : system_.terms)
    term->add_tangent({time, u, still_}, {time, scaled_, still_}, q_);
  if (euler_) euler_->add_change(scaled_, q_);
  for_chunks(system_.size(), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(q_, A) = (-1 / scale) * at(q_, A);
  });
  free_.remove_from(q_);
  ++tangents_;
  return dot(p_, q_);
}

/// Conjugate gradients for A s = r until the residual, in the norm of the preconditioner, has
/// fallen to the square root of `share` of itself. Their coefficients are the numbers of a
/// tridiagonal matrix whose eigenvalues are among those of P^-1 A (Lanczos).
template <int D>
typename QuasiStatics<D>::Direction QuasiStatics<D>::direction(Real time, const NodalVectors& u,
                                                               Real share) {
  const auto precondition = [&] {
    preconditioner_->apply(g_, z_);
    free_.remove_from(z_);
    return dot(g_, z_);
  };
  if (euler_) euler_->look_back();
  g_ = r_;
  s_ = still_;
  Real rz = precondition();
  const Real first = rz;
  p_ = z_;
  Direction found;
  std::vector<Real> diagonal, beside;
  Real carried = 0;  // of the last iteration to the diagonal
  for (int k = 0; k < most_tangents && rz > 0; ++k) {
    const Real curvature = apply(time, u);
    diagonal.push_back(curvature / rz + carried);
    if (!(curvature > 0)) {
      found.bent = true;
      if (k == 0) s_ = z_;
      break;
    }
    const Real a = rz / curvature;
    add(s_, a, p_);
    add(g_, -a, q_);
    const Real before = rz;
    rz = precondition();
    if (rz <= std::max(share * first, polished * tolerance_ * energy_scale_)) break;
    const Real b = rz / before;
    beside.push_back(std::sqrt(b) / a);
    carried = b / a;
    for_chunks(system_.size(), [&](Index, Index begin, Index end) {
      for (Index A = begin; A < end; ++A) at(p_, A) = at(z_, A) + b * at(p_, A);
    });
  }
  // A few iterations see the stiffest modes alone.
  constexpr std::size_t enough = 10;
  if (!diagonal.empty()) {
    beside.resize(diagonal.size() - 1);
    const Real least = least_eigenvalue(diagonal, beside);
    if (diagonal.size() >= enough || least < stability_) stability_ = least;
  }
  stability_ = std::min(stability_, 1e3);  // where there was nothing to see
  found.decrement = 0.5 * dot(s_, r_);
  return found;
}

template <int D>
bool QuasiStatics<D>::search(Real time, Point& point, Real decrement) {
  constexpr Real least_share = 1e-4, noise = 1e-13, least = 1e-6;
  Point trial;
  for (Real a = 1; a > least; a /= 2) {
    trial.u = point.u;
    add(trial.u, a, s_);
    if (!evaluate(time, trial, trial_r_)) continue;
    const Real released = point.potential - trial.potential;
    if (released < 2 * least_share * a * decrement - noise * std::abs(point.potential)) continue;
    energy_scale_ = std::max(energy_scale_, released);
    point = std::move(trial);
    r_.swap(trial_r_);
    return true;
  }
  return false;
}

template <int D>
typename QuasiStatics<D>::Solution QuasiStatics<D>::solve(const State& state, Real time) {
  Solution solution = iterated(state, time);
  constexpr int smooth = 8;
  solution.hard = solution.far = solution.bent || solution.iterations > smooth;
  solution.hard |= solution.stuck;
  if (last_dt_ == 0 || solution.far) return solution;
  // From what the last step has led to expect.
  z_ = solution.point.u;
  add(z_, -1, state.u);
  add(z_, -(time - state.time) / last_dt_, last_du_);
  solution.far = largest(z_) > (time - state.time) / last_dt_ * largest(last_du_);
  return solution;
}

template <int D>
typename QuasiStatics<D>::Solution QuasiStatics<D>::iterated(const State& state, Real time) {
  Solution solution;
  Point& point = solution.point;
  free_ = FreeMotions<D>(system_, {time, state.u, still_}, spacing_);
  if (!begin_at(state, time, point)) {
    solution.failure = "forces cannot be computed there: " + broken_;
    return solution;
  }
  if (!euler_ && !(solution.failure = pulled(time, point.u)).empty()) return solution;
  const Real floor = euler_ ? 1e-3 * choice_.force_tolerance * scale_of_flow(stored_size(state))
                            : 1e-18 * preconditioner_->elements().energy_scale();
  stability_ = unbounded;
  Real before = 0;
  bool bent = false;  // in the last iteration
  for (;; ++solution.iterations) {
    if (solution.iterations == most_iterations) {
      solution.failure = fmt::format(
          "Newton's method has not ended after {} iterations, {:.2g} of "
          "the energy is left",
          most_iterations, left_);
      return solution;
    }
    constexpr Real loosest = 0.1, sharper = 0.9;
    preconditioner_->apply(r_, z_);
    const Real size = dot(r_, z_);
    // What is left is at most r.P^-1 r / 2 over the least eigenvalue.
    if (solution.iterations > 0 && stability_ > 0 && !bent &&
        size <= 2 * stability_ * polished * tolerance_ * energy_scale_) {
      left_ = size / (2 * stability_ * energy_scale_);
      return solution;
    }
    // As sharp as the quadratic convergence of the last iteration is worth (Eisenstat & Walker
    // 1996).
    const Real fallen = before > 0 ? size / before : 1;
    const Real share = std::min(loosest, sharper * fallen * fallen);
    before = size;
    const Direction found = direction(time, point.u, share);
    bent = found.bent;
    ++iterations_;
    solution.bent |= found.bent;
    if (solution.iterations == 0) energy_scale_ = std::max(energy_scale_, found.decrement);
    left_ = found.decrement / std::max(energy_scale_, floor);
    const bool small = found.decrement <= tolerance_ * energy_scale_ + floor;
    if (small && !found.bent) {
      add(point.u, 1, s_);
      if (!evaluate(time, point, r_))
        solution.failure = "forces cannot be computed there: " + broken_;
      return solution;
    }
    Real decrement = found.decrement;
    if (small) {  // nothing pulls away from a state that is not stable
      s_ = p_;
      if (dot(s_, r_) < 0)
        for (NodalVector& w : s_) w = -1.0 * w;
      const Real length = spacing_ / largest(s_);
      for (NodalVector& w : s_) w *= length;
      decrement = 0;
    }
    constexpr Real longest = 2;  // spacings
    const Real length = largest(s_) / (longest * spacing_);
    if (length > 1) {
      for (NodalVector& w : s_) w /= length;
      decrement /= length;
    }
    if (!search(time, point, decrement)) {
      if (small) return solution;               // flat to the last digit
      if (euler_ && solution.iterations > 0) {  // an edge in the potential: as far as it goes
        solution.stuck = true;
        return solution;
      }
      solution.failure =
          fmt::format("no step of Newton's method lowers the energy, {:.2g} of it is left", left_);
      return solution;
    }
  }
}

template <int D>
void QuasiStatics<D>::settle(State& state) {
  stop_motion(state);
  if (euler_) return;
  if (!preconditioner_) preconditioner_.emplace(system_);
  if (at_equilibrium_) return;
  const Solution solution = solve(state, state.time);
  if (!solution.failure.empty())
    throw SolveError(fmt::format("no equilibrium is found at the beginning: {}{}", solution.failure,
                                 unbalanced(state, state.time)));
  state.books.dissipated += move(state, state.time, solution.point.u).released();
  system_.commit(state.motion());
  at_equilibrium_ = true;
}

/// Moves the state by scaled_, and books the work from outside.
template <int D>
typename QuasiStatics<D>::Exchange QuasiStatics<D>::move(State& state, Real time,
                                                         const NodalVectors& u) {
  const Real stored = stored_energy(state.motion()), begin = state.time;
  for (Index A = 0; A < system_.size(); ++A) at(scaled_, A) = at(u, A) - at(state.u, A);
  const NodalVectors from = state.u;
  const std::vector<Real> lambda = state.reactions.force;
  state.u = u;
  state.time = time;
  state.demand = system_.compute_forces(state.motion(), state.forces()).demand;
  if (system_.constraints) {
    reactions(state.force, state.reactions.force);
    system_.constraints->add_transposed(state.reactions.force, 1, state.force);
  }
  work_ = work_between({begin, from, lambda}, {time, state.u, state.reactions.force});
  book(state, work_);
  return {std::accumulate(work_.begin(), work_.end(), 0.0), stored_energy(state.motion()) - stored};
}

/// Of each held face and, last, of all else from outside, by the mean of the forces before and
/// after.
template <int D>
std::vector<Real> QuasiStatics<D>::work_between(const Equilibrium& before,
                                                const Equilibrium& after) {
  for (Index A = 0; A < system_.size(); ++A) at(q_, A) = at(after.u, A) - at(before.u, A);
  const Motion from{before.time, before.u, q_}, to{after.time, after.u, q_};
  std::vector<Real> work;
  if (system_.constraints) {
    system_.constraints->apply(q_, lambda_);
    for (const auto& one : system_.constraints->all()) {
      work.push_back(0);
      for (Index r = one->first; r < one->first + one->rows.size(); ++r)
        work.back() += 0.5 * (at(before.lambda, r) + at(after.lambda, r)) * at(lambda_, r);
    }
  }
  work.push_back(0.5 * (system_.load_power(from) + system_.load_power(to)));
  for (const auto& term : system_.terms)
    if (after.time > before.time && term->steady_after() > before.time)
      work.back() += term->work_between(from, to);
  return work;
}

template <int D>
void QuasiStatics<D>::book(State& state, const std::vector<Real>& work) const {
  for (std::size_t k = 0; k < work.size(); ++k) {
    state.books.external_work += work[k];
    if (k + 1 < work.size()) state.reactions.work[k] += work[k];
  }
}

/// What the means of the forces before and after leave out of the work over this piece of a step
/// and the last, by that over both together. Half of it: the other half of what bends over a piece
/// is seen with the neighbour on its other side, and a way back takes back what the way there has
/// booked (quasi-statics note 2).
template <int D>
void QuasiStatics<D>::book_bend(const State& before, State& state) {
  NodalVectors first = before.u;
  add(first, -1, last_du_);
  std::vector<Real> bend = work_between({before.time - last_dt_, first, last_lambda_},
                                        {state.time, state.u, state.reactions.force});
  const Real part = last_dt_ / (last_dt_ + state.time - before.time), rest = 1 - part;
  const Real half = 0.5 * (part * part * part + rest * rest * rest);
  for (std::size_t k = 0; k < bend.size(); ++k)
    bend[k] = half * (last_work_[k] + work_[k] - bend[k]) / (3 * part * rest);
  book(state, bend);
}

/// Forces of the constraints at an equilibrium.
template <int D>
void QuasiStatics<D>::reactions(const NodalVectors& force, std::vector<Real>& lambda) const {
  system_.constraints->apply_over_mass(force, lambda);
  for (Real& x : lambda) x = -x;
  system_.constraints->solve(lambda);
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
Real QuasiStatics<D>::stored_energy(const Motion& motion) const {
  Real sum = 0;
  for (const auto& term : system_.terms) sum += term->stored_energy(motion).value_or(0);
  return sum;
}

template <int D>
std::vector<Residual> QuasiStatics<D>::residuals(const State&) const {
  return {{"energy left", left_, euler_ ? choice_.force_tolerance : tolerance},
          {"stability", stability_, std::nullopt},
          {"jumps", static_cast<Real>(jumps_), std::nullopt}};
}

template <int D>
std::string QuasiStatics<D>::obstacle(const State& state) const {
  return net_forces(system_, state);
}

template <int D>
std::string QuasiStatics<D>::effort() const {
  return fmt::format("{} iterations of Newton's method with {} tangents", iterations_, tangents_);
}

template <int D>
void QuasiStatics<D>::archive(const Archive& a, const State&) {
  a("last_change", last_du_, D, dimension::length);
  a("last_time", last_dt_, dimension::time);
  a("last_work", last_work_, of_sum(dimension::energy, D));
  if (!last_lambda_.empty()) a("last_reactions", last_lambda_, of_sum(dimension::force, D));
  a("energy_scale", energy_scale_, of_sum(dimension::energy, D));
  a("energy_left", left_);
  a("stability", stability_);
  a("jumps", jumps_);
  a("step_of_flow", tau_, dimension::time);
  a("power", power_, of_sum(dimension::power, D));
  a("released", released_, of_sum(dimension::energy, D));
  a("all_released", all_released_, of_sum(dimension::energy, D));
  a("moment_of_release", moment_of_release_);
  a("began", began_, dimension::time);
  a("at_equilibrium", at_equilibrium_);
  a("arrived", arrived_);
  require_saved(last_dt_ >= 0 && energy_scale_ >= 0 && jumps_ >= 0 && tau_ >= 0, a, "last_time");
}

namespace {

template <int D>
bool is_inviscid(System<D>& system, const Body<D>& body) {
  constexpr Real round_off = 1e-12;
  const ElasticModuli at_rest = elastic_moduli(system, body),
                      sheared = elastic_moduli(system, body, 1);
  return sheared.shear - at_rest.shear <= round_off * at_rest.lame;
}

template <int D>
std::unique_ptr<Stepper<D>> make(System<D>& system, const StepperChoice& choice) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(choice.place + ": \"newton\" looks for states of least energy; " + what);
  };
  for (std::size_t b = 0; b < choice.fluid.size(); ++b)
    if (choice.fluid[b] && is_inviscid(system, system.bodies[b]))
      refuse(
          fmt::format("body '{}' is a fluid without viscosity, whose flow to rest nothing resists; "
                      "give its material a viscosity, which changes the way but not the rest, or "
                      "use \"relax\"",
                      system.bodies[b].name));
  for (const Unknown& field : system.fields)
    refuse(fmt::format("the field '{}' is another unknown beside the displacement; use \"relax\"",
                       field.spec.name));
  const NodalVectors rest(static_cast<std::size_t>(system.size()), Lanes::zero());
  for (auto& term : system.terms)
    if (!term->potential({0, rest, rest, system.fields}))
      refuse(
          fmt::format("the force of {} is not the gradient of an energy, so that there is no "
                      "least one; use \"relax\"",
                      term->name()));
  return std::make_unique<QuasiStatics<D>>(system, choice);
}

const bool registered =
    register_entry(StepperEntry{"newton", {"energy_left", "stability", "jumps"}, make<2>, make<3>});

}  // namespace

template class QuasiStatics<2>;
template class QuasiStatics<3>;

}  // namespace meniscus
