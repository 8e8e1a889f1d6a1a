// SPDX-License-Identifier: BSD-3-Clause
// The flow of fluids to their equilibrium, by steps of implicit Euler.
#pragma once
#include "meniscus/solve/stepper.hpp"
#include "solve/newton/newton_method.hpp"
#include "solve/newton/outer_work.hpp"
#include "solve/step/rest.hpp"

namespace meniscus {

/// (quasi-statics note 8) No shear brings a fluid back, so that with one the tangent is singular.
/// It flows to its equilibrium: a step is one of implicit Euler against viscosity and inertia, from
/// rest, and lasts as long as its time says. Steps are doubled while the energy that they release
/// does not fall fast, and the run ends where little is left to release. What static forces do on
/// the way is dissipated.
template <int D>
class FlowToRest final : public Stepper<D> {
 public:
  /// Every term has a potential, there is no field beside the displacement, and some body is a
  /// fluid; all fluids are viscous.
  FlowToRest(System<D>& system, const StepperChoice& choice);

  bool implicit() const override { return true; }
  void begin(const State& state) override;
  void settle(State& state) override;
  /// The step of implicit Euler, which is not longer than the load step while loads change.
  Real longest_step(const State& state) override;
  /// In pieces where it is too long to be solved for. Throws SolveError where these are none.
  void step(State& state, Real dt) override;
  /// Little energy is left to release under loads that are steady, or the time is over.
  bool arrived() const override { return arrived_; }
  std::vector<Residual> residuals(const State& state) const override;
  std::string obstacle(const State& state) const override;
  std::string effort() const override { return method_.effort(); }
  void stop_when(const std::function<bool()>& asked) override { method_.stop_when(asked); }
  void archive(const Archive& a, const State& state) override;

 private:
  Real stored_size(const State& state) const;
  Real scale_of_flow(Real stored) const;
  Real work_of_forces(const State& from, const State& to);
  /// After a step of dt; `whole_step`: that was neither cut nor hard to find.
  void judge_rest(const State& state, Real dt, Real released, bool whole_step);

  System<D>& system_;
  StepperChoice choice_;
  FluidRest<D> fluids_;
  ImplicitEuler<D> euler_;
  NewtonMethod<D> method_;
  OuterWork<D> work_;
  NodalVectors still_, middle_force_;
  std::vector<Real> lambda_;  // per row of the constraints
  Real left_ = 1;             // energy to release, relative to that released
  bool has_static_forces_ = false, arrived_ = false;
  // Since loads are steady.
  Real tau_ = 0;                       // next step of implicit Euler; 0: not known
  Real power_ = 0, released_ = 0;      // of the last step, and energy by the last whole one
  Real all_released_ = 0, began_ = 0;  // energy so far, since that time
  Real moment_of_release_ = 0;         // sum of energy times its time
};

}  // namespace meniscus
