// SPDX-License-Identifier: BSD-3-Clause
// Step control: a fraction of the stable step, or the step that was asked for.
#pragma once
#include "solve/step/time_step.hpp"

#include <optional>

namespace meniscus {

/// Between estimates of the stable step it follows what terms demand: stiffness beyond the one they
/// had at the last estimate shortens the step at once (frequencies squared add up at most).
template <int D>
class StepController {
 public:
  struct Choice {
    std::optional<Real> fixed;        ///< step asked for
    Real safety = 0.9;                ///< else this fraction of the stable step
    int check_every = 100;            ///< most steps between estimates
    std::string place = {};           ///< of the fixed step in the scene, to begin a message with
    bool implicit_viscosity = false;  ///< viscosity does not limit the step
  };

  StepController(System<D>& system, Choice choice)
      : system_(system), estimator_(system, !choice.implicit_viscosity), choice_(choice) {}

  /// Estimates the stable step at the start of a run. Throws InputError if a fixed step exceeds it.
  /// All ranks know the state before and after.
  void begin(State& state);

  /// Of the estimates between steps.
  void tell_reads(StepReads& reads) { estimator_.tell_reads(reads); }

  /// The next step: not longer than `accurate`, down to a tenth of what is stable (a thousandth
  /// with implicit viscosity), unless it is
  /// fixed. The last two are shortened to arrive at `end` exactly. Throws SolveError when the
  /// stable step has collapsed to a millionth of the first.
  Real next(State& state, Real end, Real accurate = unbounded);

  /// A step was rejected: the next ones are not longer than `dt`, until the next estimate.
  void shorten(Real dt) { step_ = std::min(step_, dt); }

  const StableStep& stable() const { return stable_; }
  /// The step that stability and terms allow.
  Real allowed() const { return step_; }
  /// Returns once: that a fixed step has come close to the stable one, or that the stable step has
  /// fallen to a hundredth of the first.
  std::optional<std::string> take_warning() { return std::exchange(warning_, std::nullopt); }

  /// A run goes on as before, or, if step or safety were chosen differently then, by the new
  /// choice: throws as begin().
  void archive(const Archive& a);

 private:
  void choose_step();
  void reconsider(State& state);
  void plan_next_check(const State& state);
  Real allowed_step(const State& state) const;
  void respect_demand(State& state);

  System<D>& system_;
  StableStepEstimator<D> estimator_;
  Choice choice_;
  StableStep stable_;
  Real step_ = 0, first_limit_ = 0;
  Real interval_ = 0;  ///< steps from one estimate to the next
  std::int64_t next_check_ = 0, last_check_ = 0;
  Real known_stiffness_ = 0;  ///< demanded when the stable step was estimated, so part of it
  bool warned_ = false;
  std::optional<std::string> warning_;
};

}  // namespace meniscus
