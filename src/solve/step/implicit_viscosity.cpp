// SPDX-License-Identifier: BSD-3-Clause
// Solves for the velocity at the end of a step by conjugate gradients.
#include "solve/step/implicit_viscosity.hpp"

#include "numbers/dense.hpp"
#include "parallel/nodal_algebra.hpp"
#include "solve/step/leapfrog.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus {
namespace {

/// Largest residual, in the norm of the preconditioner and relative to sqrt(v . M v).
constexpr Real tolerance = 1e-4;
/// Usually up to 200 iterations are needed; up to 1000 where stress points are nearly folded and
/// F^-1 makes the viscosity stiff. A shorter step hardly changes the latter.
constexpr int most_iterations = 2000;
/// Number of steps after which the diagonal is computed again, which costs about as much as a
/// force.
constexpr std::int64_t longest_age = 100;

/// Position of the coefficient of a particle.
template <int D>
Eigen::Vector3d place(const Body<D>& body, const State& state, Index A) {
  Eigen::Vector3d x = spatial(at(state.u, A));
  x.head<D>() += at(body.particles.X(), A - body.first);
  return x;
}

/// Sums of m, m x and r over a body.
struct Moments {
  Real mass = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), momentum = Eigen::Vector3d::Zero();
  friend Moments operator+(const Moments& a, const Moments& b) {
    return {a.mass + b.mass, a.centre + b.centre, a.momentum + b.momentum};
  }
};

/// Inertia of a body about its centre, and the moment of r.
struct Rotation {
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  friend Rotation operator+(const Rotation& a, const Rotation& b) {
    return {a.inertia + b.inertia, a.momentum + b.momentum};
  }
};

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
  system_.for_particles([&](Index begin, Index end) {
    std::copy(state.v.begin() + begin, state.v.begin() + end, half_.begin() + begin);
  });
  // First guess of v_n+1, from the predicted force.
  NodalVectors& predicted = r_;
  prediction_.predict(state.force, dt, system_.mass, predicted, system_.followed);
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      at(state.v, A) += (dt / 2 / at(system_.mass, A)) * at(predicted, A);
  });
  if (system_.constraints) system_.constraints->prescribe(half_, state.time, dt, state.v);
  Report report;
  try {
    report = forces_with_velocity(state, dt);
  } catch (const SolveError&) {
    state.v = half_;
    leapfrog::drift(system_, state, -dt);
    throw;
  }
  std::swap(state.v, half_);  // reactions refer to the last half kick, starting at v
  system_.react(state, dt);
  std::swap(state.v, half_);
  leapfrog::settle(state, dt);
  leapfrog::kick_fields(state, dt / 2);
  leapfrog::conclude(system_, state, report, dt, 0.5);
  prediction_.step_stands();
  ++steps_;
}

/// Computes force and velocity at the end of the step, starting from the guess in state.v. Each
/// iteration changes v by a p and the force by - a C p, so that the force always belongs to v
/// without a new evaluation.
template <int D>
Report ImplicitViscosity<D>::forces_with_velocity(State& state, Real dt) {
  Report report = system_.compute_forces(state.motion(), state.forces());
  if (age_ >= longest_age) renew_diagonal();
  ++age_;
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(r_, A) =
          at(system_.mass, A) * (at(half_, A) - at(state.v, A)) + dt / 2 * at(state.force, A);
      at(e_, A) = at(Ce_, A) = Lanes::zero();
    }
  });
  const Real motion = system_.sum_over_particles(
      0.0, [&](Index A) { return at(system_.mass, A) * sum(at(half_, A) * at(half_, A)); });
  Real rz = precondition(dt);
  p_ = z_;
  for (int k = 0; !(rz <= tolerance * tolerance * motion); ++k) {  // also goes on for NaN
    if (k == most_iterations) throw not_found(state, std::sqrt(rz / motion));
    const Real a = rz / apply(state, dt);
    system_.for_particles([&](Index begin, Index end) {
      for (Index A = begin; A < end; ++A) {
        const Lanes change = a * at(p_, A), resisted = -a * at(q_, A);
        at(e_, A) += change;
        at(Ce_, A) += resisted;
        at(r_, A) -= at(system_.mass, A) * change + dt / 2 * resisted;
      }
    });
    const Real before = rz;
    rz = precondition(dt);
    system_.for_particles([&](Index begin, Index end) {
      for (Index A = begin; A < end; ++A) at(p_, A) = at(z_, A) + (rz / before) * at(p_, A);
    });
    ++iterations_;
  }
  // (v + e) . C (v + e) - v . C v, C symmetric
  report.heat += system_.sum_over_particles(
      0.0, [&](Index A) { return sum((2 * at(state.v, A) + at(e_, A)) * at(Ce_, A)); });
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A) {
      at(state.v, A) += at(e_, A);
      at(state.force, A) -= at(Ce_, A);
    }
  });
  add_missing_drag(state, report.outside);
  add_missing_rigid_motion(state);
  return report;
}

/// Corrects the resultant of external forces for the change of the velocity since the terms
/// reported. Only friction and dampers act from outside; other viscous forces have no resultant.
template <int D>
void ImplicitViscosity<D>::add_missing_drag(const State& state, Resultant& outside) const {
  if (outside.force_size == 0) return;
  for (const Body<D>& body : system_.bodies) {
    const Resultant change = system_.sum_over_particles(body, Resultant(), [&](Index A) {
      const Eigen::Vector3d f = -spatial(at(Ce_, A));
      return Resultant(f, cross(place(body, state, A), f));
    });
    outside.force += change.force;
    outside.moment += change.moment;
  }
}

/// The error of a step whose velocity was not found. A new trial of the step will compute a new
/// diagonal.
template <int D>
StepError ImplicitViscosity<D>::not_found(const State& state, Real residual) {
  age_ = longest_age;
  for (NodalVectors* x : {&r_, &z_}) system_.followed.complete(*x);
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
  system_.for_particles([&](Index begin, Index end) {
    std::fill(diagonal_.begin() + begin, diagonal_.begin() + end, Lanes::zero());
  });
  system_.add_viscous_diagonal(diagonal_);
  age_ = 0;
}

template <int D>
Real ImplicitViscosity<D>::precondition(Real dt) {
  if (system_.constraints) system_.constraints->balance(r_, lambda_);
  system_.for_particles([&](Index begin, Index end) {
    for (Index A = begin; A < end; ++A)
      at(z_, A) = at(r_, A) / (at(system_.mass, A) + dt / 2 * at(diagonal_, A));
  });
  const Real rz =
      system_.sum_over_particles(0.0, [&](Index A) { return sum(at(r_, A) * at(z_, A)); });
  if (system_.constraints) system_.constraints->project(z_);
  return rz;
}

template <int D>
Real ImplicitViscosity<D>::apply(const State& state, Real dt) {
  system_.for_particles([&](Index begin, Index end) {
    std::fill(q_.begin() + begin, q_.begin() + end, Lanes::zero());
  });
  system_.add_viscous({state.time, state.u, p_, state.fields}, q_);
  return system_.sum_over_particles(0.0, [&](Index A) {
    return sum(at(p_, A) * (at(system_.mass, A) * at(p_, A) - dt / 2 * at(q_, A)));
  });
}

template <int D>
void ImplicitViscosity<D>::list_reads(StepReads& reads) {
  reads.keeps(diagonal_);
  prediction_.list_reads(reads);
}

/// Adds the rigid motion of each body whose momenta are the sums of the residual. Rigid motions
/// cause no viscous force except friction, which does not conserve momenta. Held bodies are
/// skipped, since they have no rigid motion.
template <int D>
void ImplicitViscosity<D>::add_missing_rigid_motion(State& state) const {
  for (const Body<D>& body : system_.bodies) {
    if (system_.constraints && system_.constraints->hold_any(body.first, body.size())) continue;
    const RigidVelocity missing = missing_motion(body, state);
    system_.for_particles([&](Index begin, Index end) {
      for (Index A = std::max(begin, body.first); A < std::min(end, body.first + body.size());
           ++A) {
        const Eigen::Vector3d v =
            missing.velocity + cross(missing.spin, place(body, state, A) - missing.centre);
        Lanes& own = at(state.v, A);
        for (int i = 0; i < D; ++i) own.set(i, own[i] + v[i]);
      }
    });
  }
}

template <int D>
typename ImplicitViscosity<D>::RigidVelocity ImplicitViscosity<D>::missing_motion(
    const Body<D>& body, const State& state) const {
  const auto sum_over_body = [&](auto zero, auto&& f) {
    return system_.sum_over_particles(body, zero, f);
  };
  const Moments all = sum_over_body(Moments{}, [&](Index A) {
    const Real m = at(system_.mass, A);
    return Moments{m, m * place(body, state, A), spatial(at(r_, A))};
  });
  const Eigen::Vector3d centre = all.centre / all.mass;
  if (system_.revolved())
    return {centre, {0, all.momentum[1] / all.mass, 0}, Eigen::Vector3d::Zero()};
  const Rotation about = sum_over_body(Rotation{}, [&](Index A) {
    const Eigen::Vector3d y = place(body, state, A) - centre;
    return Rotation{
        at(system_.mass, A) * (y.squaredNorm() * Eigen::Matrix3d::Identity() - y * y.transpose()),
        cross(y, spatial(at(r_, A)))};
  });
  return {centre, all.momentum / all.mass, inverse<3>(about.inertia) * about.momentum};
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
