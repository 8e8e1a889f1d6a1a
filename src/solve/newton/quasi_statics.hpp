// SPDX-License-Identifier: BSD-3-Clause
// Quasi-statics: equilibria from load step to load step.
#pragma once
#include "meniscus/solve/stepper.hpp"
#include "solve/newton/newton_method.hpp"
#include "solve/newton/outer_work.hpp"

namespace meniscus {

/// (quasi-statics note 2) Each load step looks for the minimum of the potential at its time,
/// downhill from the equilibrium before. A step that does not find it is halved.
///
/// A body that snaps from one equilibrium to another releases energy that no outer work accounts
/// for. That is booked as dissipated, once pieces of the load step have shown that it does not
/// vanish with them. So is what the first state has been away from equilibrium.
///
/// There is no motion: what kinetic energy a state has is dissipated by the first step.
template <int D>
class QuasiStatics final : public Stepper<D> {
 public:
  /// Every term has a potential, there is no field beside the displacement, and no body is a fluid.
  QuasiStatics(System<D>& system, const StepperChoice& choice);

  bool implicit() const override { return true; }
  void begin(const State& state) override;
  /// From wherever a run begins to the equilibrium at that time.
  void settle(State& state) override;
  /// The load step: that of the scene, or a twentieth of its time; less to meet the end of a ramp.
  Real longest_step(const State& state) override;
  /// Throws SolveError where no equilibrium is found.
  void step(State& state, Real dt) override;
  /// At the equilibrium of the final loads, or at the end of loads that never cease to change.
  bool arrived() const override { return arrived_; }
  std::vector<Residual> residuals(const State& state) const override;
  std::string obstacle(const State& state) const override;
  std::optional<Real> stability(const State&) const override { return method_.stability(); }
  std::vector<std::string> take_notes() override { return std::exchange(notes_, {}); }
  std::string effort() const override { return method_.effort(); }
  void stop_when(const std::function<bool()>& asked) override { method_.stop_when(asked); }
  void archive(const Archive& a, const State& state) override;

  const NewtonMethod<D>& method() const { return method_; }
  std::int64_t jumps() const { return jumps_; }

 private:
  typename NewtonMethod<D>::Solution solve(const State& state, Real time);
  bool is_far(const State& state, Real time,
              const typename NewtonMethod<D>::Solution& solution) const;
  void note_saddle(Real time);
  void book_jump(State& state, Real since, Real released);

  System<D>& system_;
  StepperChoice choice_;
  NewtonMethod<D> method_;
  OuterWork<D> work_;
  std::int64_t jumps_ = 0;
  bool at_equilibrium_ = false, arrived_ = false;
  std::vector<std::string> notes_;
};

}  // namespace meniscus
