// SPDX-License-Identifier: BSD-3-Clause
// Dynamics with implicit viscosity: steps that only sound, tension and contact limit.
#pragma once
#include "solve/step/force_prediction.hpp"
#include "solve/system.hpp"

namespace meniscus {

/// (performance note 4.1) Central differences whose viscous force is that of the mean of the
/// velocities before and after a kick (Crank and Nicolson), with M the masses and C the viscous
/// matrix at the places of the kick:
///   M (v+ - v-) = dt (f - C (v- + v+)/2).
/// As a step between states at whole steps, where v_n = (v- + v+)/2:
///   v+ = v_n + dt/2 M^-1 (f_n - C v_n),   u_n+1 = u_n + dt v+,
///   (M + dt/2 C) v_n+1 = M v+ + dt/2 f_n+1.
/// The last by conjugate gradients with the diagonal as preconditioner; they begin with the force
/// that those of the steps before predict. Stable where central differences without viscosity are.
/// The heat of a kick is dt v_n . C v_n without error, and momentum and angular momentum are kept
/// whatever is left of the residual: each body that is not held gets the rigid motion that it
/// misses. Where faces are held, v_n+1 is looked for among the velocities that they allow
/// (held-faces note 2).
template <int D>
class ImplicitViscosity {
 public:
  explicit ImplicitViscosity(System<D>& system);

  /// As meniscus::advance; also throws StepError `of_step` where no velocity is found.
  void advance(State& state, Real dt);

  void tell_reads(StepReads& reads);

  /// Of all steps of this object so far, per step.
  Real mean_iterations() const {
    return steps_ > 0 ? static_cast<Real>(iterations_) / static_cast<Real>(steps_) : 0;
  }
  void archive(const Archive& a);

 private:
  Report forces_with_velocity(State& state, Real dt);
  StepError not_found(const State& state, Real residual);
  void renew_diagonal();
  /// z = (M + dt/2 diagonal)^-1 r, of what faces that are held leave free; returns r.z.
  Real precondition(Real dt);
  /// q = - C p; returns p . (M p - dt/2 q).
  Real apply(const State& state, Real dt);
  void add_missing_drag(const State& state, Resultant& outside) const;
  void add_missing_rigid_motion(State& state) const;
  /// That takes the residual of a body away.
  struct RigidVelocity {
    Eigen::Vector3d centre, velocity, spin;
  };
  RigidVelocity missing_motion(const Body<D>& body, const State& state) const;

  System<D>& system_;
  ForcePrediction prediction_;
  NodalVectors diagonal_;                       // of C
  std::int64_t age_ = 0;                        // steps since it was computed
  NodalVectors half_, e_, Ce_, r_, z_, p_, q_;  // v+, v - guess, C e, and those of the iteration
  std::vector<Real> lambda_;                    // of what holds the residual
  std::int64_t iterations_ = 0, steps_ = 0;
};

}  // namespace meniscus
