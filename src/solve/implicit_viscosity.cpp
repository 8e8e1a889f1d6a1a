// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients for the velocity at the end of a step.
#include "meniscus/solve/implicit_viscosity.hpp"

#include "meniscus/core/dense.hpp"
#include "meniscus/core/nodal_algebra.hpp"

#include <fmt/core.h>

#include <cmath>

#include "leapfrog.hpp"

namespace meniscus {
namespace {

/// Of the residual, in the norm of the preconditioner, relative to sqrt(v . M v).
constexpr Real tolerance = 3e-5;
/// Up to 200 as a rule, and up to 1000 where stress points nearly fold and F^-1 makes viscosity
/// stiff there, which a shorter step hardly changes.
constexpr int most_iterations = 2000;
/// Steps until the diagonal is computed again, which costs about as much as a force.
constexpr std::int64_t longest_age = 20;

}  // namespace

template <int D>
ImplicitViscosity<D>::ImplicitViscosity(System<D>& system)
    : system_(system), prediction_(static_cast<std::size_t>(system.size())), age_(longest_age) {
  const NodalVectors zero(static_cast<std::size_t>(system.size()), Lanes::zero());
  diagonal_ = half_ = e_ = Ce_ = r_ = z_ = p_ = q_ = zero;
  for (auto& term : system.terms)
    if (term->viscous()) term->expect_viscous_calls();
  if (system.constraints) lambda_.resize(static_cast<std::size_t>(system.constraints->rows()));
}

template <int D>
void ImplicitViscosity<D>::advance(State& state, Real dt) {
  leapfrog::kick(system_, state, dt / 2);
  system_.depart(state);
  leapfrog::drift(system_, state, dt);
  system_.constrain(state, dt);
  system_.arrive(state, dt);
  half_ = state.v;
  // The guess of v_n+1, by the predicted force.
  NodalVectors& predicted = r_;
  prediction_.predict(state.force, dt, system_.mass, predicted);
  leapfrog::kick(state.v, predicted, system_.mass, dt / 2);
  if (system_.constraints) system_.constraints->prescribe(half_, state.time, dt, state.v);
  Report report;
  try {
    report = forces_with_velocity(state, dt);
  } catch (const SolveError&) {
    state.v = half_;
    leapfrog::drift(system_, state, -dt);
    throw;
  }
  std::swap(state.v, half_);  // reactions are of the last half kick, which begins with that
  system_.react(state, dt);
  std::swap(state.v, half_);
  leapfrog::settle(state, dt);
  leapfrog::kick_fields(state, dt / 2);
  leapfrog::conclude(system_, state, report, dt, 0.5);
  prediction_.step_stands();
  ++steps_;
}

/// Force and velocity at the end of the step, by the guess in state.v. Every iteration changes v by
/// a p and the force by - a C p, so that the force is that of v without another evaluation.
template <int D>
Report ImplicitViscosity<D>::forces_with_velocity(State& state, Real dt) {
  Report report = system_.compute_forces(state.motion(), state.forces());
  if (age_ >= longest_age) renew_diagonal();
  ++age_;
  for_chunks(system_.size(), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(r_, A) =
          at(system_.mass, A) * (at(half_, A) - at(state.v, A)) + dt / 2 * at(state.force, A);
      at(e_, A) = at(Ce_, A) = Lanes::zero();
    }
  });
  const Real motion = parallel_sum(system_.size(), 0.0, [&](Index A) {
    return at(system_.mass, A) * sum(at(half_, A) * at(half_, A));
  });
  Real rz = precondition(dt);
  p_ = z_;
  for (int k = 0; !(rz <= tolerance * tolerance * motion); ++k) {  // also not a number
    if (k == most_iterations) throw not_found(state, std::sqrt(rz / motion));
    const Real a = rz / apply(state, dt);
    for_chunks(system_.size(), [&](Index, Index begin, Index end) {
      for (Index A = begin; A < end; ++A) {
        const Lanes change = a * at(p_, A), resisted = a * at(q_, A);
        at(e_, A) += change;
        at(Ce_, A) += resisted;
        at(r_, A) -= at(system_.mass, A) * change + dt / 2 * resisted;
      }
    });
    const Real before = rz;
    rz = precondition(dt);
    for_chunks(system_.size(), [&](Index, Index begin, Index end) {
      for (Index A = begin; A < end; ++A) at(p_, A) = at(z_, A) + (rz / before) * at(p_, A);
    });
    ++iterations_;
  }
  // (v + e) . C (v + e) - v . C v, C symmetric
  report.heat += 2 * dot(state.v, Ce_) + dot(e_, Ce_);
  for_chunks(system_.size(), [&](Index, Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(state.v, A) += at(e_, A);
      at(state.force, A) -= at(Ce_, A);
    }
  });
  add_missing_rigid_motion(state);
  return report;
}

/// A step that is tried again has a diagonal of its own.
template <int D>
StepError ImplicitViscosity<D>::not_found(const State& state, Real residual) {
  age_ = longest_age;
  Index worst = 0;
  for (Index A = 0; A < system_.size(); ++A)
    if (sum(at(r_, A) * at(z_, A)) > sum(at(r_, worst) * at(z_, worst))) worst = A;
  const std::string cause = fmt::format(
      "implicit viscosity: the velocity is not found within {} iterations, the residual is {:.3g} "
      "of the motion, {:.3g} is asked for",
      most_iterations, residual, tolerance);
  return StepError(system_.located({worst, cause, true}, state.motion()));
}

template <int D>
void ImplicitViscosity<D>::renew_diagonal() {
  std::fill(diagonal_.begin(), diagonal_.end(), Lanes::zero());
  for (auto& term : system_.terms)
    if (term->viscous()) term->add_viscous_diagonal(diagonal_);
  age_ = 0;
}

template <int D>
Real ImplicitViscosity<D>::precondition(Real dt) {
  if (system_.constraints) system_.constraints->balance(r_, lambda_);
  const Real rz = parallel_sum(system_.size(), 0.0, [&](Index A) {
    const Lanes& r = at(r_, A);
    at(z_, A) = r / (at(system_.mass, A) + dt / 2 * at(diagonal_, A));
    return sum(r * at(z_, A));
  });
  if (system_.constraints) system_.constraints->project(z_);
  return rz;
}

template <int D>
Real ImplicitViscosity<D>::apply(const State& state, Real dt) {
  std::fill(q_.begin(), q_.end(), Lanes::zero());
  for (auto& term : system_.terms)
    if (term->viscous()) term->add_viscous({state.time, state.u, p_, state.fields}, q_);
  return parallel_sum(system_.size(), 0.0, [&](Index A) {
    at(q_, A) = -1.0 * at(q_, A);
    return sum(at(p_, A) * (at(system_.mass, A) * at(p_, A) + dt / 2 * at(q_, A)));
  });
}

/// The residual of each body is taken by the rigid motion with the momenta that it stands for.
/// Rigid motions cause no viscous force, but for friction, which does not keep momenta. Nor does a
/// body that is held, which has no rigid motion.
template <int D>
void ImplicitViscosity<D>::add_missing_rigid_motion(State& state) const {
  for (const Body<D>& body : system_.bodies) {
    if (system_.constraints && system_.constraints->hold_any(body.first, body.size())) continue;
    Real mass = 0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(), momentum = centre, angular = centre;
    const auto place = [&](Index A) {
      Eigen::Vector3d x = spatial(at(state.u, body.first + A));
      x.head<D>() += at(body.particles.X(), A);
      return x;
    };
    for (Index A = 0; A < body.size(); ++A) {
      mass += at(system_.mass, body.first + A);
      centre += at(system_.mass, body.first + A) * place(A);
      momentum += spatial(at(r_, body.first + A));
    }
    centre /= mass;
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    for (Index A = 0; A < body.size(); ++A) {
      const Eigen::Vector3d y = place(A) - centre;
      inertia += at(system_.mass, body.first + A) *
                 (y.squaredNorm() * Eigen::Matrix3d::Identity() - y * y.transpose());
      angular += cross(y, spatial(at(r_, body.first + A)));
    }
    const Eigen::Vector3d velocity = momentum / mass, spin = inverse<3>(inertia) * angular;
    for (Index A = 0; A < body.size(); ++A) {
      const Eigen::Vector3d v = velocity + cross(spin, place(A) - centre);
      Lanes& own = at(state.v, body.first + A);
      for (int i = 0; i < D; ++i) own.set(i, own[i] + v[i]);
    }
  }
}

template <int D>
void ImplicitViscosity<D>::archive(const Archive& a) {
  a("diagonal", diagonal_, D);
  a("age", age_);
  prediction_.archive(a, D);
  require_saved(age_ >= 0 && age_ <= longest_age, a, "implicit_viscosity/age");
}

template class ImplicitViscosity<2>;
template class ImplicitViscosity<3>;

}  // namespace meniscus
