// SPDX-License-Identifier: BSD-3-Clause
// Dynamics with implicit viscosity. The step is limited by sound, surface tension and contact, not
// by viscosity.
#pragma once
#include "solve/step/force_prediction.hpp"
#include "solve/system.hpp"

namespace meniscus {

/// Central differences with the viscous force at the mean of the velocities before and after a kick
/// (Crank and Nicolson; performance note 4.1). M are the masses, and C is the viscous matrix at the
/// positions of the kick:
///   M (v+ - v-) = dt (f - C (v- + v+)/2).
/// As a step between states at whole steps, where v_n = (v- + v+)/2:
///   v+ = v_n + dt/2 M^-1 (f_n - C v_n),   u_n+1 = u_n + dt v+,
///   (M + dt/2 C) v_n+1 = M v+ + dt/2 f_n+1.
/// The last equation is solved by conjugate gradients with a diagonal preconditioner. The first
/// guess uses a force predicted from earlier steps. The step is stable where central differences
/// without viscosity are stable.
///
/// The heat of a kick is exactly dt v_n . C v_n. Momentum and angular momentum are conserved in
/// spite of the residual, since each body that is not held gets the missing rigid motion. With held
/// faces, v_n+1 is sought among the velocities that they allow (held-faces note 2).
template <int D>
class ImplicitViscosity {
 public:
  explicit ImplicitViscosity(System<D>& system);

  /// Makes a step, like meniscus::advance(). Also throws StepError `of_step` if no velocity is
  /// found.
  void advance(State& state, Real dt);

  void list_reads(StepReads& reads);

  /// Iterations per step, averaged over all steps of this object.
  Real mean_iterations() const {
    return steps_ > 0 ? static_cast<Real>(iterations_) / static_cast<Real>(steps_) : 0;
  }
  void archive(const Archive& a);

 private:
  Report forces_with_velocity(State& state, Real dt);
  StepError not_found(const State& state, Real residual);
  void renew_diagonal();
  /// z = (M + dt/2 diagonal)^-1 r, projected on the motions that held faces leave free. Returns
  /// r.z.
  Real precondition(Real dt);
  /// q = - C p. Returns p . (M p - dt/2 q).
  Real apply(const State& state, Real dt);
  void add_missing_drag(const State& state, Resultant& outside) const;
  void add_missing_rigid_motion(State& state) const;
  /// The rigid motion that removes the residual of a body in momentum and angular momentum.
  struct RigidVelocity {
    Eigen::Vector3d centre, velocity, spin;
  };
  RigidVelocity missing_motion(const Body<D>& body, const State& state) const;

  System<D>& system_;
  ForcePrediction prediction_;
  NodalVectors diagonal_;                       // of C
  std::int64_t age_ = 0;                        // steps since it was computed
  NodalVectors half_, e_, Ce_, r_, z_, p_, q_;  // v+, v - guess, C e, vectors of the iteration
  std::vector<Real> lambda_;                    // multipliers of the constraints
  std::int64_t iterations_ = 0, steps_ = 0;
};

}  // namespace meniscus
