// SPDX-License-Identifier: BSD-3-Clause
// Quasi-statics: a sequence of equilibria, one per load step.
#pragma once
#include "meniscus/solve/stepper.hpp"
#include "solve/newton/newton_method.hpp"
#include "solve/newton/outer_work.hpp"

namespace meniscus {

/// Each load step finds the minimum of the potential at its time, downhill from the previous
/// equilibrium (quasi-statics note 2). A load step that fails is halved.
///
/// A body that snaps from one equilibrium to another releases energy that no external work
/// explains. This energy is booked as dissipated if it does not vanish when the load step is
/// divided into pieces. The energy that the initial state releases on its way to equilibrium is
/// also booked as dissipated.
///
/// There is no motion: the first step dissipates the kinetic energy of the state.
template <int D>
class QuasiStatics final : public Stepper<D> {
 public:
  /// Requires that every term has a potential, that there are no fields beside the displacement,
  /// and that no body is a fluid.
  QuasiStatics(System<D>& system, const StepperChoice& choice);

  bool implicit() const override { return true; }
  void begin(const State& state) override;
  /// Moves the first state of a run to the equilibrium at its time.
  void settle(State& state) override;
  /// The load step: the step of the scene, or a twentieth of the run. Shorter if a ramp ends
  /// before.
  Real longest_step(const State& state) override;
  /// Makes a load step. Throws SolveError if no equilibrium is found.
  void step(State& state, Real dt) override;
  /// True at the equilibrium of the final loads, or at the end time if loads change forever.
  bool arrived() const override { return arrived_; }
  std::vector<Residual> residuals(const State& state) const override;
  std::string obstacle(const State& state) const override;
  std::optional<Real> stability(const State&) const override { return method_.stability(); }
  std::vector<std::string> take_notes() override { return std::exchange(notes_, {}); }
  std::string effort() const override { return method_.effort(); }
  void stop_when(const std::function<bool()>& asked) override { method_.stop_when(asked); }
  std::string doing() const override { return method_.doing(); }
  std::optional<NodalVectors> response(const State& state, const NodalVectors& force) override {
    return method_.response(state.time, state.u, force);
  }
  void archive(const Archive& a, const State& state) override;

  const NewtonMethod<D>& method() const { return method_; }
  std::int64_t jumps() const { return jumps_; }

 private:
  typename NewtonMethod<D>::Solution solve(const State& state, Real time);
  bool is_far(const State& state, Real time,
              const typename NewtonMethod<D>::Solution& solution) const;
  void note_saddle(Real time);
  void note_flat(Real time);
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
