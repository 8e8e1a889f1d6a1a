// SPDX-License-Identifier: BSD-3-Clause
// Flow of fluids to their equilibrium, by steps of implicit Euler.
#pragma once
#include "meniscus/solve/stepper.hpp"
#include "solve/newton/newton_method.hpp"
#include "solve/newton/outer_work.hpp"
#include "solve/step/rest.hpp"

namespace meniscus {

/// Equilibria of systems with fluids (quasi-statics note 8). A fluid has no shear stiffness, so its
/// tangent is singular. It is therefore moved to its equilibrium by steps of implicit Euler from
/// rest, against viscosity and inertia; their length is a physical time. Steps are doubled while
/// the released energy does not decrease fast. The run ends when little energy is left to release.
/// The work of static forces on the way is dissipated.
template <int D>
class FlowToRest final : public Stepper<D> {
 public:
  /// Requires that every term has a potential, that there are no fields beside the displacement,
  /// that a body is a fluid, and that all fluids are viscous.
  FlowToRest(System<D>& system, const StepperChoice& choice);

  bool implicit() const override { return true; }
  void begin(const State& state) override;
  void settle(State& state) override;
  /// The step of implicit Euler. While loads change it is at most the load step.
  Real longest_step(const State& state) override;
  /// Makes a step, divided into pieces if it cannot be solved at once. Throws SolveError if the
  /// smallest pieces fail.
  void step(State& state, Real dt) override;
  /// True if the loads are steady and little energy is left to release, or if the end time is
  /// reached.
  bool arrived() const override { return arrived_; }
  std::vector<Residual> residuals(const State& state) const override;
  std::string obstacle(const State& state) const override;
  std::string effort() const override { return method_.effort(); }
  void stop_when(const std::function<bool()>& asked) override { method_.stop_when(asked); }
  std::string doing() const override { return method_.doing(); }
  void archive(const Archive& a, const State& state) override;

 private:
  Real stored_size(const State& state) const;
  Real scale_of_flow(Real stored) const;
  Real work_of_forces(const State& from, const State& to);
  /// Judges rest after a step of dt. `whole_step`: the step was neither divided nor hard to solve.
  void judge_rest(const State& state, Real dt, Real released, bool whole_step);

  System<D>& system_;
  StepperChoice choice_;
  FluidRest<D> fluids_;
  ImplicitEuler<D> euler_;
  NewtonMethod<D> method_;
  OuterWork<D> work_;
  NodalVectors still_, middle_force_;
  std::vector<Real> lambda_;  // [row of the constraints]
  Real left_ = 1;             // energy left to release / energy released
  bool has_static_forces_ = false, arrived_ = false;
  // Quantities since the loads are steady.
  Real tau_ = 0;                   // next step of implicit Euler; 0: unknown
  Real power_ = 0, released_ = 0;  // power of the last step, energy released by the last whole step
  Real all_released_ = 0, began_ = 0;  // energy released since the time began_
  Real moment_of_release_ = 0;         // sum of released energy times its time
};

}  // namespace meniscus
