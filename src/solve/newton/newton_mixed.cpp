// SPDX-License-Identifier: BSD-3-Clause
// Newton's method with expected pressures and factors of the tangent.
#include "parallel/nodal_algebra.hpp"
#include "solve/newton/newton_method.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meniscus {
/// Forces of displacements of a small part of a spacing. Round-off leaves a part of 1e-12 of them.
template <int D>
Real NewtonMethod<D>::least_loads() {
  constexpr Real part = 1e-4;
  if (least_loads_ == 0)
    for (const Body<D>& body : system_.bodies) {
      const ElasticModuli moduli = elastic_moduli(system_, body);
      Real volume = 0;
      for (Index A = 0; A < body.size(); ++A) volume += body.cells.volume(A);
      least_loads_ +=
          part * (moduli.lame + moduli.shear) * spacing_ * (D == 3 ? std::cbrt(volume) : 1);
    }
  return least_loads_;
}

/// The size of the forces that are in balance: of loads, of reactions, or, without any, a small
/// part of the stresses.
template <int D>
Real NewtonMethod<D>::size_of_loads(Real time, const NodalVectors& u) {
  constexpr Real of_stresses = 1e-3;
  const Motion motion{time, u, still_};
  Real size = least_loads();
  for (auto& term : system_.terms) {
    if (TangentFactors<D>::is_internal(*term)) {
      size = std::max(size, of_stresses * term->uncancelled_force(motion));
    } else {
      z_ = still_;
      system_.add_force(*term, motion, z_);
      size = std::max(size, sum_of_sizes(z_));
    }
  }
  if (system_.constraints) {
    z_ = still_;
    system_.constraints->add_transposed(lambda_, 1, z_);
    size = std::max(size, sum_of_sizes(z_));
  }
  return size;
}

template <int D>
Real NewtonMethod<D>::energy_of_bodies(Real time, const NodalVectors& u) {
  Real sum = 0;
  for (const auto& term : system_.terms)
    if (TangentFactors<D>::is_internal(*term))
      sum += term->stored_energy({time, u, still_}).value_or(0);
  return sum;
}

/// The pressures at `u` and their derivatives along `change`.
template <int D>
typename NewtonMethod<D>::Pressures NewtonMethod<D>::pressures(Real time, const NodalVectors& u,
                                                               const NodalVectors& change) {
  Pressures all;
  for (AssembledForce* force : factors_->forces())
    all.push_back(force->pressures({time, u, still_}, {time, change, still_}));
  return all;
}

/// Assembles the tangent at `u` with the expected pressures, and factorises it. The pressures are
/// the true ones if `expected` is empty, or if they give fewer negative eigenvalues.
template <int D>
void NewtonMethod<D>::renew_factors(Real time, const NodalVectors& u, const OfGroups& expected,
                                    Real shift) {
  factored_.u.clear();
  const auto renew = [&](const OfGroups& off) {
    off_ = off;
    factors_->assemble(time, u, off_, free_);
    return negative_ = factors_->factor(shift);
  };
  if (expected.empty()) {
    renew({});
    return;
  }
  OfGroups off = expected;
  const Pressures here = pressures(time, u, still_);
  for (std::size_t k = 0; k < off.size(); ++k)
    for (std::size_t g = 0; g < off[k].size(); ++g) off[k][g] = off[k][g] - here[k][g].v;
  const Index negative = renew(off);
  if (negative > 0 && renew({}) >= negative) renew(off);
}

/// Factorises the tangent of a state, unless this was done last.
template <int D>
void NewtonMethod<D>::factor_at(Real time, const NodalVectors& u) {
  if (factored_.time == time && factored_.free.modes().size() == free_.modes().size() &&
      factored_.u.size() == u.size()) {
    NodalVectors change = u;
    add(change, -1, factored_.u);
    if (largest(change) == 0) return;
  }
  renew_factors(time, u, {}, factors_->least_shift());
  factored_ = {time, free_, u};
}

/// Solves K z = r with the tangent of all forces to a part of the first residual, or less exactly
/// where it is nearly singular. Returns false if the tangent is not positive.
template <int D>
bool NewtonMethod<D>::solve_tangent(Real time, const NodalVectors& u, const NodalVectors& r,
                                    Real share) {
  constexpr std::size_t most = 40;
  g_ = r;
  Lanczos seen;
  return !conjugate_gradients(
      time, u, seen, [&](const NodalVectors& f, NodalVectors& z) { factors_->apply(f, z); },
      [&](Real first, Real left) {
        return left <= share * share * first || seen.diagonal.size() == most;
      });
}

/// Root of the integral of |grad w|^2.
template <int D>
Real NewtonMethod<D>::gradients(const NodalVectors& w) {
  Real sum = 0;
  for (AssembledForce* force : factors_->forces()) sum += force->squared_gradients({0, w, still_});
  return std::sqrt(sum);
}

/// The pressures to which a part `a` of a step leads, from `expected` before.
template <int D>
typename NewtonMethod<D>::OfGroups NewtonMethod<D>::pressures_after(const Pressures& along, Real a,
                                                                    const OfGroups& expected) {
  OfGroups next(along.size());
  for (std::size_t k = 0; k < along.size(); ++k)
    for (std::size_t g = 0; g < along[k].size(); ++g) {
      const Dual<Lanes>& p = along[k][g];
      const Lanes before = off_.empty() ? p.v : expected[k][g];
      next[k].push_back(before + a * (p.v + p.d - before));
    }
  return next;
}

/// Makes the step s_, or a part of it. The judge computes the next step with the tangent of this
/// one, from the forces after it, in which the expected pressures replace the true ones. It accepts
/// a step if the next one is shorter. Returns false if it accepts no part.
template <int D>
bool NewtonMethod<D>::step_mixed(Real time, Point& point, OfGroups& expected) {
  constexpr int halvings = 6;
  constexpr Real rough = 1e-2, nearly_at_rest = 1e-6;
  const NodalVectors step = s_;
  const Real length = gradients(step), forces = sum_of_sizes(r_);
  const Pressures along = pressures(time, point.u, step);
  Real a = 1;
  for (int k = 0; k < halvings; ++k, a /= 2) {
    Point trial;
    trial.u = point.u;
    add(trial.u, a, step);
    if (!evaluate(time, trial, trial_r_)) continue;
    OfGroups next = pressures_after(along, a, expected);
    const Pressures there = pressures(time, trial.u, still_);
    NodalVectors judged = trial_r_, way = step;
    for (NodalVector& w : way) w *= a;
    OfGroups off = next;
    for (std::size_t f = 0; f < off.size(); ++f)
      for (std::size_t g = 0; g < off[f].size(); ++g) off[f][g] = there[f][g].v - off[f][g];
    system_.add_by({time, point.u, still_}, judged, [&](const Forces& all) {
      for (std::size_t f = 0; f < off.size(); ++f)
        factors_->forces()[f]->subtract_pressure_force({time, point.u, still_}, {time, way, still_},
                                                       off[f], all);
    });
    solve_tangent(time, point.u, judged, rough);
    const bool shorter = gradients(s_) <= (1 - a / 4) * length;
    // Near rest, round-off can outweigh the rest of the step.
    if (!shorter && !(left_ < nearly_at_rest && sum_of_sizes(trial_r_) < 0.5 * forces)) continue;
    expected = std::move(next);
    point = std::move(trial);
    r_.swap(trial_r_);
    return true;
  }
  return false;
}

/// Makes a step downhill from a state whose tangent has negative eigenvalues. The tangent gets a
/// shift that makes it positive, at most twice as large as needed; the search begins with the last
/// shift. Returns false if no part of the step lowers the energy.
template <int D>
bool NewtonMethod<D>::step_downhill(Real time, Point& point, Real& shift) {
  constexpr int most = 50;
  constexpr Real beginning = 10;
  if (!off_.empty()) renew_factors(time, point.u, {}, factors_->small_shift());
  const Real least = beginning * factors_->small_shift();
  if (shift == 0) shift = least;
  bool positive = factors_->factor(shift) == 0;
  while (positive && shift > least) {
    positive = factors_->factor(shift / 2) == 0;
    if (positive) shift /= 2;
  }
  for (int k = 0; k < most && !positive; ++k) {
    positive = factors_->factor(shift) == 0;
    if (!positive) shift *= 2;
  }
  factors_->apply(r_, s_);
  free_.remove_from(s_);
  const Real decrement = 0.5 * dot(s_, r_);
  return decrement > 0 && search(time, point, decrement / shorten_direction());
}

/// Places a point at the previous state, with held places where they are now. If forces cannot be
/// computed there, the point moves with the change of the forces in time, to first order. Sets the
/// pressures to expect. Returns false if forces cannot be computed there either.
template <int D>
bool NewtonMethod<D>::begin_mixed(const Start& start, Point& point, OfGroups& expected) {
  constexpr Real part = 1e-4;
  point.u = start.u;
  factor_at(start.before, point.u);
  factors_->meet(start.time, point.u);
  const auto moved = [&] {
    NodalVectors way = point.u;
    add(way, -1, start.u);
    return way;
  };
  if (evaluate(start.time, point, r_)) {
    expected = pressures_after(pressures(start.before, start.u, moved()), 1, {});
    return true;
  }
  const Real dt = start.time - start.before;
  Point before{start.u, 0}, after = before;
  if (!(dt > 0) || !evaluate(start.before, before, r_) ||
      !evaluate(start.before + part * dt, after, trial_r_))
    return false;
  add(trial_r_, -1, r_);
  for (NodalVector& f : trial_r_) f *= 1 / part;
  factors_->apply(trial_r_, s_);
  free_.remove_from(s_);
  add(point.u, 1, s_);
  expected = pressures_after(pressures(start.time, start.u, moved()), 1, {});
  return evaluate(start.time, point, r_);
}

/// Newton's method with expected pressures, to which the last step has led, in place of the true
/// ones (quasi-statics note 10). The volume changes after a straight step are wrong in second
/// order, and pressures by the bulk modulus times that. Tangents with such pressures have negative
/// eigenvalues that belong to no instability. The iteration ends when the forces left are small
/// beside loads and reactions.
template <int D>
void NewtonMethod<D>::iterate_mixed(const Start& start, Solution& solution, Point& point) {
  solution.mixed = true;
  find_lowest_of_reference();
  OfGroups expected;
  if (!begin_mixed(start, point, expected)) {
    solution.failure = too_far;
    return;
  }
  for (;;) {
    approach(start.time, solution, point, std::move(expected));
    if (!solution.failure.empty() || stays(start.time, point, solution)) return;
    expected.clear();
  }
}

/// Iterates from a point to an equilibrium. `expected` may be empty.
template <int D>
void NewtonMethod<D>::approach(Real time, Solution& solution, Point& point, OfGroups expected) {
  constexpr int most = 50, most_downhill = 50, many = 15;
  constexpr Real exact = 1e-4, acceptable = 1e-6, bearable = 1e-3;
  Real shift = 0;
  solution.failure = too_far;  // until the iteration ends
  for (int steps = 0, downhill = 0; steps < most && downhill < most_downhill;) {
    if (asked_to_stop_()) throw Interrupted();
    const Real forces = sum_of_sizes(r_);
    left_ = forces > 0 ? forces / size_of_loads(time, point.u) : 0;
    if (left_ <= tolerance_) return polish(time, solution, point);
    renew_factors(time, point.u, expected, factors_->small_shift());
    ++iterations_;
    ++solution.iterations;
    if (negative_ == 0 && solve_tangent(time, point.u, r_, exact)) {
      // Along a valley of the energy, forces are small but steps are long.
      solution.flat = ++steps > many && left_ <= bearable &&
                      dot(s_, r_) <= tolerance_ * std::abs(energy_of_bodies(time, point.u));
      if (solution.flat) return polish(time, solution, point);
      if (step_mixed(time, point, expected)) continue;
      if (left_ <= acceptable) return polish(time, solution, point);
    }
    solution.bent = true;
    ++downhill;
    if (!step_downhill(time, point, shift)) return;
    expected.clear();
  }
}

/// Ends the iteration. Another step with the present factors costs little.
template <int D>
void NewtonMethod<D>::polish(Real time, Solution& solution, Point& point) {
  constexpr Real exact = 1e-4;
  solution.failure.clear();
  Point trial;
  if (!solve_tangent(time, point.u, r_, exact)) return;
  trial.u = point.u;
  add(trial.u, 1, s_);
  if (!evaluate(time, trial, trial_r_)) return;
  const Real before = sum_of_sizes(r_), after = sum_of_sizes(trial_r_);
  if (!(after < before)) return;
  left_ *= after / before;
  point = std::move(trial);
  r_.swap(trial_r_);
}

template Real NewtonMethod<2>::least_loads();
template Real NewtonMethod<3>::least_loads();
template Real NewtonMethod<2>::size_of_loads(Real, const NodalVectors&);
template Real NewtonMethod<3>::size_of_loads(Real, const NodalVectors&);
template void NewtonMethod<2>::iterate_mixed(const Start&, Solution&, Point&);
template void NewtonMethod<3>::iterate_mixed(const Start&, Solution&, Point&);
template void NewtonMethod<2>::factor_at(Real, const NodalVectors&);
template void NewtonMethod<3>::factor_at(Real, const NodalVectors&);

}  // namespace meniscus
