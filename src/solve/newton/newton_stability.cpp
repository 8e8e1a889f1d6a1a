// SPDX-License-Identifier: BSD-3-Clause
// Stability of equilibria, and the way from an unstable one.
#include "numbers/dense.hpp"
#include "numbers/random.hpp"
#include "parallel/nodal_algebra.hpp"
#include "solve/newton/newton_method.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace meniscus {

/// The least eigenvalue of K x = lambda M x for the present factors of K, where M are the masses:
/// the square of the lowest frequency. If the factors have negative eigenvalues, the greatest
/// negative one, whose mode x goes to p_; then 0 if it is not found. The iteration of Lanczos for
/// K^-1 M, in the product of M.
template <int D>
Real NewtonMethod<D>::lowest_frequency() {
  constexpr int fewest = 6, most = 40;
  constexpr Real settled = 0.01;
  const Real sign = negative_ > 0 ? 1 : -1;
  const auto times_mass = [&](const NodalVectors& w, NodalVectors& Mw) {
    for (Index A = 0; A < system_.size(); ++A) at(Mw, A) = at(system_.mass, A) * at(w, A);
  };
  const auto respond = [&](NodalVectors force, NodalVectors& w) {
    free_.remove_from(force);
    factors_->apply(force, w);
    free_.remove_from(w);
  };
  NodalVectors v = still_, Mv = still_, w = still_;
  std::mt19937_64 bits(61);
  for (NodalVector& force : w)
    for (int i = 0; i < D; ++i) force.set(i, symmetric_uniform(bits));
  respond(w, v);
  Lanczos seen;  // of K^-1 M times the sign
  std::vector<NodalVectors> all;
  Real beside = 0, greatest = 0;
  for (int k = 0; k < most; ++k) {
    times_mass(v, Mv);
    const Real length = std::sqrt(dot(v, Mv));
    if (!(length > 0)) break;
    if (k > 0) seen.beside.push_back(beside = length);
    for (NodalVector& x : v) x *= 1 / length;
    for (NodalVector& x : Mv) x *= 1 / length;
    respond(Mv, w);
    const Real diagonal = dot(w, Mv);
    seen.diagonal.push_back(sign * diagonal);
    const Real now = -seen.least();
    if (k + 1 >= fewest && now > 0 && now - greatest < settled * now) {
      all.push_back(v);
      break;
    }
    greatest = now;
    add(w, -diagonal, v);
    if (!all.empty()) add(w, -beside, all.back());
    all.push_back(v);
    std::swap(v, w);
  }
  const Real found = seen.diagonal.empty() ? 0 : -seen.least();
  if (!(found > 0)) return negative_ > 0 ? 0 : unbounded;
  if (negative_ == 0) return 1 / found;
  const Eigen::VectorXd part = least_eigenvector(seen.diagonal, seen.beside);
  p_ = still_;
  for (std::size_t k = 0; k < all.size(); ++k) add(p_, part[static_cast<Eigen::Index>(k)], all[k]);
  return -1 / found;
}

/// Bodies alone, without loads and contacts, but held.
template <int D>
void NewtonMethod<D>::find_lowest_of_reference() {
  if (lowest_ > 0) return;
  const FreeMotions<D> here = std::exchange(
      free_,
      FreeMotions<D>(system_, {0, still_, still_}, spacing_, TangentFactors<D>::is_internal));
  factored_.u.clear();
  factors_->assemble_reference(free_);
  factors_->factor(factors_->least_shift());
  negative_ = 0;
  lowest_ = lowest_frequency();
  free_ = here;
}

/// True if the equilibrium is stable. Forces of a symmetric scene have no component along modes
/// that break the symmetry, so iterations that start with them never find such modes. Therefore
/// these iterations start with random forces, whose numbers are the same on any machine, with any
/// number of threads and processes. They end when the least eigenvalue hardly falls relative to its
/// size; the nearer it is to zero, the more accurate it becomes.
template <int D>
bool NewtonMethod<D>::is_stable_at(Real time, const NodalVectors& u) {
  constexpr Real neutral = 1e-6, settled = 0.15, all_gone = 1e-12;
  constexpr std::size_t fewest = 12, apart = 4;  // numbers of iterations
  std::mt19937_64 bits(61);
  for (NodalVector& force : g_)
    for (int i = 0; i < D; ++i) force.set(i, symmetric_uniform(bits));
  free_.remove_from(g_);
  Lanczos seen;
  Real before = unbounded;
  const bool bent = conjugate_gradients(time, u, seen, by_elements(), [&](Real first, Real left) {
    if (left <= all_gone * first) return true;
    const std::size_t k = seen.diagonal.size();
    if (k % apart != 0) return false;
    const Real least = seen.least();
    const bool falls = std::exchange(before, least) - least > settled * least;
    return k >= fewest && !falls;
  });
  stability_ = std::min(seen.diagonal.empty() ? unbounded : seen.least(), 1e3);
  if (!(stability_ > -1e3)) stability_ = -1e3;  // also for NaN
  // Round-off can give a free motion a small negative eigenvalue.
  if (stability_ > -neutral) stability_ = std::max(stability_, 0.0);
  return !bent || stability_ >= 0;
}

template <int D>
Real NewtonMethod<D>::find_stability(Real time, const NodalVectors& u) {
  prepare();
  free_ = FreeMotions<D>(system_, {time, u, still_}, spacing_);
  system_.add_up({time, u, still_}, r_);
  is_stable_at(time, u);
  return stability_;
}

/// Tests whether the equilibrium at `point` is stable. If not, moves `point` along the unstable
/// mode and returns false, and Newton's method continues from there. Returns true for a stable
/// equilibrium and for a step of implicit Euler. Also returns true if no lower energy is found
/// along the mode, or after several unstable equilibria, whose energy is then flat to round-off.
template <int D>
bool NewtonMethod<D>::stays(Real time, Point& point, Solution& solution) {
  constexpr int often = 3;
  bool stable;
  if (solution.mixed) {
    factor_at(time, point.u);
    stability_ = std::min(lowest_frequency() / lowest_, 1e3);
    stable = !(stability_ < 0);
  } else {
    // A step of implicit Euler need not be stable, because it is no equilibrium.
    stable = step_ || is_stable_at(time, point.u);
  }
  if (stable || solution.saddles == often) return true;
  solution.bent = true;
  leave_saddle();
  if (!search(time, point, 0)) return true;
  ++solution.saddles;
  return false;
}

template <int D>
NodalVectors NewtonMethod<D>::response(Real time, const NodalVectors& u,
                                       const NodalVectors& force) {
  constexpr Real exact = 1e-10;
  const Motion motion{time, u, still_};
  free_ = FreeMotions<D>(system_, motion, spacing_);
  r_ = force;
  if (system_.constraints) system_.constraints->balance(r_, lambda_);
  free_.remove_from(r_);
  bool stable;
  if (factors_ && !TangentFactors<D>::others_resist(system_, motion)) {
    factor_at(time, u);
    stable = negative_ == 0 && solve_tangent(time, u, r_, exact);
    off_.clear();
  } else {
    Lanczos seen;
    g_ = r_;
    stable = !conjugate_gradients(time, u, seen, by_elements(), [](Real first, Real left) {
      return left <= exact * exact * first;
    });
  }
  if (!stable)
    throw SolveError(
        fmt::format("the equilibrium at t = {:.6g} is not stable: there are no derivatives", time));
  return s_;
}

template <int D>
void NewtonMethod<D>::leave_saddle() {
  s_ = p_;
  if (dot(s_, r_) < 0)
    for (NodalVector& w : s_) w = -1.0 * w;
  const Real length = spacing_ / largest(s_);
  for (NodalVector& w : s_) w *= length;
}

#define MENISCUS_INSTANTIATE(D)                                             \
  template void NewtonMethod<D>::find_lowest_of_reference();                \
  template Real NewtonMethod<D>::find_stability(Real, const NodalVectors&); \
  template bool NewtonMethod<D>::stays(Real, Point&, Solution&);            \
  template void NewtonMethod<D>::leave_saddle();                            \
  template NodalVectors NewtonMethod<D>::response(Real, const NodalVectors&, const NodalVectors&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
