// SPDX-License-Identifier: BSD-3-Clause
// Truncated Newton method with conjugate gradients.
#include "solve/newton/newton_method.hpp"

#include "numbers/dense.hpp"
#include "parallel/nodal_algebra.hpp"
#include "solve/least_spacing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meniscus {
namespace {

/// Fraction of the tolerance below which another iteration would change nothing.
constexpr Real polished = 1e-3;
constexpr int most_directions = 60, most_tangents = 400;

}  // namespace

template <int D>
NewtonMethod<D>::NewtonMethod(System<D>& system, ImplicitEuler<D>* step, Real tolerance)
    : system_(system),
      step_(step),
      tolerance_(tolerance),
      spacing_(least_spacing(system.bodies)),
      small_(!step && TangentFactors<D>::suit(system)) {
  still_.assign(static_cast<std::size_t>(system.size()), Lanes::zero());
  if (system.constraints) lambda_.resize(static_cast<std::size_t>(system.constraints->rows()));
  r_ = trial_r_ = s_ = g_ = z_ = p_ = q_ = scaled_ = still_;
}

template <int D>
void NewtonMethod<D>::prepare() {
  if (preconditioner_ && step_) preconditioner_->renew(system_, step_);
  if (!small_) elements();
  if (step_) energy_scale_ = 0;
}

/// Made when it is needed first.
template <int D>
const HeldPreconditioner<D>& NewtonMethod<D>::elements() {
  if (!preconditioner_) preconditioner_.emplace(system_, step_);
  return *preconditioner_;
}

/// Describes a net force along a translation that nothing resists, for one body or all bodies.
/// Empty if there is none.
template <int D>
std::string NewtonMethod<D>::pulled(Real time, const NodalVectors& u) {
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
    return largest(q_) <= round_off * elements().elements().stiffness_scale();
  };
  for (int i = 0; i < D; ++i) {
    if (in_direction(nullptr, i)) return "nothing holds the bodies in the direction of the forces";
    for (const Body<D>& body : system_.bodies)
      if (in_direction(&body, i))
        return fmt::format("nothing holds body '{}' in the direction of its forces", body.name);
  }
  return "";
}

template <int D>
bool NewtonMethod<D>::begin_at(const Start& start, Point& point) {
  for (const NodalVectors* u : {start.expected, &start.u})
    if (u) {
      point.u = *u;
      elements().meet(start.time, point.u);
      if (evaluate(start.time, point, r_)) return true;
    }
  return false;
}

template <int D>
bool NewtonMethod<D>::evaluate(Real time, Point& point, NodalVectors& force) {
  const Motion motion{time, point.u, still_};
  const Report report = system_.add_up(motion, force);
  if (report.failure) broken_ = system_.located(*report.failure, motion).text();
  if (report.failure || !std::isfinite(dot(force, force))) return false;
  point.potential = 0;
  for (auto& term : system_.terms) point.potential += term->potential(motion).value();
  if (step_) point.potential += step_->add_force(point.u, force);
  if (system_.constraints) system_.constraints->balance(force, lambda_);
  free_.remove_from(force);
  return true;
}

template <int D>
Real NewtonMethod<D>::apply(Real time, const NodalVectors& u) {
  // Terms without an exact tangent use differences of forces over a part of the change.
  const Real scale = spacing_ / largest(p_);
  sweep(system_.size(), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(scaled_, A) = scale * at(p_, A);
      at(q_, A) = Lanes::zero();
    }
  });
  system_.add_tangent({time, u, still_}, {time, scaled_, still_}, q_);
  if (!off_.empty())
    system_.add_by({time, u, still_}, q_, [&](const Forces& all) {
      for (std::size_t k = 0; k < off_.size(); ++k)
        factors_->forces()[k]->add_pressure_tangent({time, u, still_}, {time, scaled_, still_},
                                                    off_[k], all);
    });
  if (step_) step_->add_change(scaled_, q_);
  sweep(system_.size(), [&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) at(q_, A) = (-1 / scale) * at(q_, A);
  });
  free_.remove_from(q_);
  ++tangents_;
  return dot(p_, q_);
}

/// Solves A s_ = g_ by conjugate gradients from s_ = 0. Ends when `done` accepts the residual,
/// measured in the squared norm of the preconditioner. Returns true if it ends at a direction p_ of
/// negative curvature. The coefficients of the iterations form a tridiagonal matrix, whose
/// eigenvalues approximate eigenvalues of P^-1 A (Lanczos).
template <int D>
bool NewtonMethod<D>::conjugate_gradients(Real time, const NodalVectors& u, Lanczos& seen,
                                          const Precondition& respond, const Done& done) {
  const auto precondition = [&] {
    respond(g_, z_);
    free_.remove_from(z_);
    return dot(g_, z_);
  };
  s_ = still_;
  Real rz = precondition();
  const Real first = rz;
  p_ = z_;
  Real carried = 0;  // contribution of the last iteration to the diagonal
  for (int k = 0; k < most_tangents && rz > 0; ++k) {
    if (asked_to_stop_()) throw Interrupted();
    const Real curvature = apply(time, u);
    seen.diagonal.push_back(curvature / rz + carried);
    if (!(curvature > 0)) return true;
    const Real a = rz / curvature;
    add(s_, a, p_);
    add(g_, -a, q_);
    const Real before = rz;
    rz = precondition();
    if (done(first, rz)) break;
    const Real b = rz / before;
    seen.beside.push_back(std::sqrt(b) / a);
    carried = b / a;
    sweep(system_.size(), [&](Index begin, Index end) {
      for (Index A = begin; A < end; ++A) at(p_, A) = at(z_, A) + b * at(p_, A);
    });
  }
  return false;
}

template <int D>
Real NewtonMethod<D>::Lanczos::least() const {
  return least_eigenvalue(
      diagonal,
      {beside.begin(), beside.begin() + static_cast<std::ptrdiff_t>(diagonal.size()) - 1});
}

/// The Newton direction. Iterates until the squared residual, in the norm of the preconditioner,
/// has fallen to `share` of its first value.
template <int D>
typename NewtonMethod<D>::Direction NewtonMethod<D>::direction(Real time, const NodalVectors& u,
                                                               Real share) {
  if (step_) step_->look_back();
  g_ = r_;
  Direction found;
  Lanczos seen;
  found.bent = conjugate_gradients(time, u, seen, by_elements(), [&](Real first, Real left) {
    return left <= std::max(share * first, polished * tolerance_ * energy_scale_);
  });
  if (found.bent && seen.diagonal.size() == 1) s_ = z_;
  // The first iterations approximate the stiffest modes only.
  constexpr std::size_t enough = 10;
  if (!seen.diagonal.empty()) {
    const Real least = seen.least();
    if (seen.diagonal.size() >= enough || least < stability_) stability_ = least;
  }
  stability_ = std::min(stability_, 1e3);  // bound in case no eigenvalue was found
  found.decrement = 0.5 * dot(s_, r_);
  return found;
}

template <int D>
bool NewtonMethod<D>::search(Real time, Point& point, Real decrement) {
  constexpr Real least_share = 1e-4, noise = 1e-13, least = 1e-6;
  Point trial;
  for (Real a = 1; a > least; a /= 2) {
    trial.u = point.u;
    add(trial.u, a, s_);
    if (!evaluate(time, trial, trial_r_)) continue;
    const Real released = point.potential - trial.potential;
    const Real enough = 2 * least_share * a * decrement - noise * std::abs(point.potential);
    if (!(released >= enough)) continue;  // also true if the energy is NaN
    energy_scale_ = std::max(energy_scale_, released);
    point = std::move(trial);
    r_.swap(trial_r_);
    return true;
  }
  return false;
}

template <int D>
typename NewtonMethod<D>::Solution NewtonMethod<D>::solve(const Start& start) {
  iterations_before_ = iterations_;
  tangents_before_ = tangents_;
  Solution solution;
  Point point;
  free_ = FreeMotions<D>(system_, {start.time, start.u, still_}, spacing_);
  if (small_ && !TangentFactors<D>::others_resist(system_, {start.time, start.u, still_})) {
    if (!factors_) factors_.emplace(system_);
    iterate_mixed(start, solution, point);
    off_.clear();
    if (!solution.failure.empty())
      if (const std::string cause = pulled(start.time, point.u); !cause.empty())
        solution.failure = cause;
    solution.u = std::move(point.u);
    return solution;
  }
  if (!begin_at(start, point))
    solution.failure = "forces cannot be computed there: " + broken_;
  else if (!step_)
    solution.failure = pulled(start.time, point.u);
  if (solution.failure.empty()) iterate(start, solution, point);
  if (solution.failure.empty() && !step_) solution.failure = forces_left(start.time, point.u);
  solution.u = std::move(point.u);
  return solution;
}

/// Describes forces that are left at a state where no energy is. Empty if they are small.
template <int D>
std::string NewtonMethod<D>::forces_left(Real time, const NodalVectors& u) {
  constexpr Real bearable = 0.01;
  const Real forces = sum_of_sizes(r_), loads = size_of_loads(time, u);
  if (!(forces > bearable * loads)) return "";
  return fmt::format(
      "no step lowers the energy, but forces of {:.2g} of loads and reactions are left",
      forces / loads);
}

/// Limits the direction to a few spacings; returns the factor by which it was too long, or 1.
template <int D>
Real NewtonMethod<D>::shorten_direction() {
  constexpr Real longest = 2;  // in spacings
  const Real length = largest(s_) / (longest * spacing_);
  if (!(length > 1)) return 1;
  for (NodalVector& w : s_) w /= length;
  return length;
}

template <int D>
void NewtonMethod<D>::iterate(const Start& start, Solution& solution, Point& point) {
  const Real floor = std::max(start.idle, 1e-18 * elements().elements().energy_scale());
  stability_ = unbounded;
  Real before = 0;
  bool bent = false;  // negative curvature in the last iteration
  for (;; ++solution.iterations) {
    if (solution.iterations == most_directions) {
      solution.failure = fmt::format(
          "Newton's method has not ended after {} iterations, {:.2g} of "
          "the energy is left",
          most_directions, left_);
      return;
    }
    constexpr Real loosest = 0.1, sharper = 0.9;
    elements().apply(r_, z_);
    const Real size = dot(r_, z_);
    // The energy that could still be released is at most r.P^-1 r / 2 over the least eigenvalue.
    if (solution.iterations > 0 && stability_ > 0 && !bent &&
        size <= 2 * stability_ * polished * tolerance_ * energy_scale_) {
      left_ = size / (2 * stability_ * energy_scale_);
      if (stays(start.time, point, solution)) return;
      before = 0;
      continue;
    }
    // Solve as accurately as the quadratic convergence of the last iteration justifies (Eisenstat &
    // Walker 1996).
    const Real fallen = before > 0 ? size / before : 1;
    const Real share = std::min(loosest, sharper * fallen * fallen);
    before = size;
    const Direction found = direction(start.time, point.u, share);
    bent = found.bent;
    ++iterations_;
    solution.bent |= found.bent;
    if (solution.iterations == 0) energy_scale_ = std::max(energy_scale_, found.decrement);
    left_ = found.decrement / std::max(energy_scale_, floor);
    const bool small = found.decrement <= tolerance_ * energy_scale_ + floor;
    if (small && !found.bent) {
      add(point.u, 1, s_);
      if (!evaluate(start.time, point, r_))
        solution.failure = "forces cannot be computed there: " + broken_;
      if (!solution.failure.empty() || stays(start.time, point, solution)) return;
      before = 0;
      continue;
    }
    Real decrement = found.decrement;
    if (small) {  // no force pulls away from this unstable state
      leave_saddle();
      decrement = 0;
    }
    decrement /= shorten_direction();
    if (search(start.time, point, decrement)) continue;
    if (small) return;  // the energy is flat to the last digit
    if (step_ && solution.iterations > 0)
      solution.stuck = true;  // the potential has a kink: no further progress
    else
      solution.failure =
          fmt::format("no step of Newton's method lowers the energy, {:.2g} of it is left", left_);
    return;
  }
}

template <int D>
bool NewtonMethod<D>::Solution::winding() const {
  const int smooth = mixed ? 15 : 8;
  return bent || iterations > smooth;
}

template <int D>
std::string NewtonMethod<D>::doing() const {
  return fmt::format("iteration {} with {} tangents, {:.2g} of the {} left",
                     iterations_ - iterations_before_ + 1, tangents_ - tangents_before_, left_,
                     factors_ ? "forces" : "energy");
}

template <int D>
std::string NewtonMethod<D>::effort() const {
  return fmt::format("{} iterations of Newton's method with {} tangents", iterations_, tangents_);
}

template <int D>
void NewtonMethod<D>::archive(const Archive& a) {
  a("energy_scale", energy_scale_, of_sum(dimension::energy, D));
  a("energy_left", left_);
  a("stability", stability_);
  require_saved(energy_scale_ >= 0, a, "energy_scale");
}

template class NewtonMethod<2>;
template class NewtonMethod<3>;

}  // namespace meniscus
