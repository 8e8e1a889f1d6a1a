// SPDX-License-Identifier: BSD-3-Clause
// Dynamic relaxation of a few shapes of a body.
//
// Only modes that the loads excite delay the rest. The slowest mode of a body may not be excited,
// so its period is a poor estimate of the time to rest.
#include "solve/step/way_to_rest.hpp"

#include "body/particle_values.hpp"
#include "input/ramp.hpp"
#include "numbers/box.hpp"
#include "parallel/nodal_algebra.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {

template <int D>
WayToRest<D>::WayToRest(System<D>& system, const HeldPreconditioner<D>& P, const State& state,
                        Real loaded)
    : system_(system), P_(P), begin_(state.time), loaded_(loaded) {
  const NodalVectors still(state.u.size(), Lanes::zero());
  const Motion start{state.time, state.u, still, state.fields};
  NodalVectors u = state.u, f = still;
  P.meet(loaded, u);
  const NodalVectors there = u;
  const Motion moved{loaded, there, still, state.fields};
  if (system.add_up(moved, f).failure) return;
  known_ = true;
  free_ = FreeMotions<D>(system, moved, std::cbrt(system.bodies.front().cells.volume(0)));
  if (system.constraints) {
    std::vector<Real> lambda(static_cast<std::size_t>(system.constraints->rows()));
    system.constraints->balance(f, lambda);
  }
  for (Index A = 0; A < system.size(); ++A) at(u, A) -= at(state.u, A);
  const bool held_moves = largest(u) > 0;
  NodalVectors change = inverse(start, f);
  add(change, 1, u);
  const bool moves = largest(change) > 0;
  find_shapes(start,
              held_moves || !moves ? inverse(start, forces_for(moves ? change : state.v)) : change);
  const auto n = static_cast<Eigen::Index>(shapes_.size());
  rest_.resize(n);
  speed_.resize(n);
  stiffness_.resize(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const NodalVectors& w = at(shapes_, j);
    rest_[j] = mass_product(w, change);
    speed_[j] = mass_product(w, state.v);
    const NodalVectors force = stiff_force(start, w);
    for (Eigen::Index i = 0; i < n; ++i) stiffness_(i, j) = dot(at(shapes_, i), force);
  }
  stiffness_ = (0.5 * (stiffness_ + stiffness_.transpose())).eval();
  find_uncancelled(moved);
}

template <int D>
Real WayToRest<D>::mass_product(const NodalVectors& a, const NodalVectors& b) const {
  return parallel_sum(system_.size(), 0.0,
                      [&](Index A) { return at(system_.mass, A) * sum(at(a, A) * at(b, A)); });
}

template <int D>
NodalVectors WayToRest<D>::forces_for(const NodalVectors& acceleration) const {
  NodalVectors f = acceleration;
  for (Index A = 0; A < system_.size(); ++A) at(f, A) = at(system_.mass, A) * at(f, A);
  return f;
}

/// By a change of the size of a thousandth of a spacing: tangents may be differences.
template <int D>
NodalVectors WayToRest<D>::stiff_force(const Motion& motion, const NodalVectors& w) const {
  const Real size = largest(w);
  NodalVectors scaled = w, f(w.size(), Lanes::zero());
  if (!(size > 0)) return f;
  const Real scale = 1e-3 * std::cbrt(system_.bodies.front().cells.volume(0)) / size;
  for (NodalVector& x : scaled) x *= scale;
  system_.add_tangent(motion, {motion.time, scaled, motion.v}, f);
  for (NodalVector& x : f) x *= -1 / scale;
  return f;
}

/// P alone is much too soft for modes in which coefficients move and places hardly do: conjugate
/// gradients take these out in few iterations.
template <int D>
NodalVectors WayToRest<D>::inverse(const Motion& motion, NodalVectors r) const {
  constexpr int most = 15;
  constexpr Real enough = 1e-3;  // of the squared residual in the norm of P^-1
  NodalVectors x(r.size(), Lanes::zero()), z = x;
  free_.remove_from(r);
  Real rz = P_.apply(r, z);
  free_.remove_from(z);
  NodalVectors p = z;
  const Real first = rz;
  for (int k = 0; k < most && rz > enough * first; ++k) {
    const NodalVectors Ap = stiff_force(motion, p);
    const Real curvature = dot(p, Ap);
    if (!(curvature > 0)) break;
    add(x, rz / curvature, p);
    add(r, -rz / curvature, Ap);
    free_.remove_from(r);
    const Real next = P_.apply(r, z);
    free_.remove_from(z);
    for (Index A = 0; A < system_.size(); ++A) at(p, A) = at(z, A) + (next / rz) * at(p, A);
    rz = next;
  }
  return x;
}

template <int D>
void WayToRest<D>::find_shapes(const Motion& motion, NodalVectors w) {
  constexpr Real independent = 1e-3;
  while (true) {
    const Real before = std::sqrt(mass_product(w, w));
    for (int pass = 0; pass < 2; ++pass)
      for (const NodalVectors& other : shapes_) add(w, -mass_product(w, other), other);
    const Real size = std::sqrt(mass_product(w, w));
    if (!(size > independent * before)) return;
    for (NodalVector& x : w) x *= 1 / size;
    NodalVectors& places = places_.emplace_back(w);
    for (const Body<D>& body : system_.bodies) {
      const NodalVectors moved = values_at_particles(body, w.data() + body.first);
      std::copy(moved.begin(), moved.end(), places.begin() + body.first);
    }
    shapes_.push_back(w);
    if (shapes_.size() == most_shapes) return;
    w = inverse(motion, forces_for(w));
  }
}

/// From a small part of the way to rest, as places far off may have no forces. A body without loads
/// comes to rest in its reference, where hardly any force is left.
template <int D>
void WayToRest<D>::find_uncancelled(const Motion& motion) {
  constexpr Real at_rest = 1e-5;
  const NodalVectors reference(motion.u.size(), Lanes::zero());
  NodalVectors f = reference;
  const Motion there{motion.time, reference, motion.v, motion.fields};
  Real left = 0, scale = 0;
  if (!system_.add_up(there, f).failure) {
    for (const NodalVector& x : f) left += std::sqrt(sum(x * x));
    for (const auto& term : system_.terms) scale += term->uncancelled_force(there);
    NodalVectors held = reference;
    P_.meet(motion.time, held);
    without_loads_ = left <= at_rest * scale && largest(held) == 0;
  }
  if (without_loads_) {
    uncancelled_ = scale;
    return;
  }
  const auto forces_at = [&](Real part) {
    NodalVectors u(motion.u.begin(), motion.u.end());
    for (std::size_t i = 0; i < shapes_.size(); ++i)
      add(u, part * rest_[static_cast<Eigen::Index>(i)], shapes_[i]);
    Real sum = 0;
    for (const auto& term : system_.terms)
      sum += term->uncancelled_force({motion.time, u, motion.v, motion.fields});
    return sum;
  };
  constexpr Real small = 1e-3;
  const Real part = std::min(1.0, small / largest_change(rest_)), now = forces_at(0);
  uncancelled_ = now + std::abs(forces_at(part) - now) / part;
}

template <int D>
Real WayToRest<D>::largest_change(const Vector& q) const {
  Real change = 0;
  for (const Body<D>& body : system_.bodies) {
    Real square = 0;
    for (Index A = body.first; A < body.first + body.size(); ++A) {
      Lanes moved = Lanes::zero();
      for (std::size_t i = 0; i < shapes_.size(); ++i)
        moved += q[static_cast<Eigen::Index>(i)] * at(places_[i], A);
      square = std::max(square, sum(moved * moved));
    }
    change =
        std::max(change, std::sqrt(square) / box_around<D>(body.particles.X()).extent().maxCoeff());
  }
  return change;
}

template <int D>
Real WayToRest<D>::sum_of_forces(const Vector& acceleration) const {
  return parallel_sum(system_.size(), 0.0, [&](Index A) {
    Lanes a = Lanes::zero();
    for (std::size_t i = 0; i < shapes_.size(); ++i)
      a += acceleration[static_cast<Eigen::Index>(i)] * at(shapes_[i], A);
    return at(system_.mass, A) * std::sqrt(sum(a * a));
  });
}

template <int D>
std::optional<Real> WayToRest<D>::time(const typename Relaxation<D>::Tolerances& tolerances,
                                       Real dt, int fewest_steps) const {
  // Of a strain of 1e-9, which has a scale, numbers show so much.
  constexpr Real round_off_of_forces = 1e-6;
  if (without_loads_ && tolerances.force < round_off_of_forces) return std::nullopt;
  if (!known_ || !stiffness_.allFinite() || !rest_.allFinite()) return std::nullopt;
  constexpr Real round_off = 1e-10;
  if (shapes_.empty() || (speed_.norm() == 0 && largest_change(rest_) < round_off))
    return std::max(loaded_, begin_) + 2 * fewest_steps * dt;
  if (!(stiffness_.ldlt().vectorD().minCoeff() > 0)) return std::nullopt;
  const Ramp ramp{begin_, loaded_ > begin_ ? loaded_ : begin_};
  const Real step = std::max(dt, 0.05 / std::sqrt(stiffness_.trace()));
  Vector q = Vector::Zero(rest_.size()), v = speed_, last_force, window_q = q, window_force;
  const auto force = [&](Real t) -> Vector { return stiffness_ * (ramp.fraction(t) * rest_ - q); };
  Vector f = force(begin_);
  window_force = f;
  Real t = begin_, window_begin = t, window = 0;
  int settled = 0;
  constexpr int most_steps = 200'000;
  for (int k = 0; k < most_steps; ++k) {
    v += step / 2 * f;
    const Vector dq = step * v;
    q += dq;
    t += step;
    last_force = f;
    f = force(t);
    v += step / 2 * f;
    const Real stiff = -dq.dot(f - last_force), inertia = dq.squaredNorm();
    if (stiff > 0 && inertia > 0)
      v *= std::exp(-2 * Relaxation<D>::damping_ratio * std::sqrt(stiff / inertia) * step);

    const bool ramps_ended = window_begin < loaded_ && t >= loaded_;
    if (!ramps_ended && t - window_begin < std::max(window, fewest_steps * dt)) continue;
    const Vector change = q - window_q;
    const Real K = -change.dot(f - window_force), M = change.squaredNorm();
    const Real omega = K > 0 && M > 0 ? std::sqrt(K / M) : 0;
    const Real left = M == 0  ? 0
                      : K > 0 ? std::hypot(change.dot(f) / K, change.dot(v) / std::sqrt(K * M))
                              : 1 / tolerances.shape;
    const Real elapsed = t - window_begin,
               quarter = omega > 0 ? std::numbers::pi / (2 * omega) : 2 * elapsed;
    const bool at_rest = window_begin >= loaded_ && elapsed >= 0.25 * quarter &&
                         left * largest_change(change) <= tolerances.shape &&
                         sum_of_forces(f) <= tolerances.force * uncancelled_;
    settled = at_rest ? settled + 1 : 0;
    if (settled == 2) return t;
    window_q = q;
    window_force = f;
    window_begin = t;
    window = ramps_ended ? 0 : std::min(0.5 * quarter, 2 * elapsed);
  }
  return std::nullopt;
}

template class WayToRest<2>;
template class WayToRest<3>;

}  // namespace meniscus
