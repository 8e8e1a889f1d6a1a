// SPDX-License-Identifier: BSD-3-Clause
// Step control: a fraction of the stable step, or the fixed step of the scene.
#pragma once
#include "meniscus/error.hpp"
#include "solve/step/time_step.hpp"

#include <optional>

namespace meniscus {

/// Chooses the step. Between estimates of the stable step, it obeys the limits of the terms
/// (StepDemand). Stiffness that was added since the last estimate shortens the step at once;
/// squared frequencies add up at most.
template <int D>
class StepController {
 public:
  struct Choice {
    std::optional<Real> fixed;        ///< fixed step of the scene
    Real safety = 0.9;                ///< otherwise this fraction of the stable step
    int check_every = 100;            ///< largest number of steps between estimates
    std::string place = {};           ///< place of the fixed step in the scene, for messages
    bool implicit_viscosity = false;  ///< viscosity does not limit the step
  };

  StepController(System<D>& system, Choice choice)
      : system_(system), estimator_(system, !choice.implicit_viscosity), choice_(choice) {}

  /// Estimates the stable step at the start of a run. Throws InputError if the fixed step is
  /// longer. The state is complete on all processes before and after this call.
  void begin(State& state);

  /// Registers the particles that estimates between steps read.
  void list_reads(StepReads& reads) { estimator_.list_reads(reads); }

  /// The next step. Unless it is fixed, it is at most `accurate`, but at least a tenth of the
  /// allowed step (a thousandth with implicit viscosity). The last two steps are shortened to end
  /// exactly at `end`. Throws SolveError if the stable step has fallen to a millionth of the first
  /// one, or the step to a rounding of the time.
  Real next(State& state, Real end, Real accurate = unbounded);

  /// Call this after a rejected step: the next steps are at most `dt`, until the next estimate.
  void shorten(Real dt, const StepFailure& rejected) {
    step_ = std::min(step_, dt);
    rejected_ = rejected;
  }

  const StableStep& stable() const { return stable_; }
  /// The step that stability and the terms allow.
  Real allowed() const { return step_; }
  /// A warning, returned once: a fixed step is close to the stable step, or the stable step has
  /// fallen to a hundredth of the first one.
  std::optional<std::string> take_warning() { return std::exchange(warning_, std::nullopt); }

  /// Saves or restores. If the step or the safety factor of a restored run differ, the new choice
  /// is used; throws like begin().
  void archive(const Archive& a);

 private:
  void choose_step();
  void reconsider(State& state);
  void plan_next_check(const State& state);
  Real allowed_step(const State& state) const;
  void respect_demand(State& state);
  StepError time_stands_still(const State& state, Real dt) const;

  System<D>& system_;
  StableStepEstimator<D> estimator_;
  Choice choice_;
  StableStep stable_;
  Real step_ = 0, first_limit_ = 0;
  Real interval_ = 0;  ///< number of steps between estimates
  std::int64_t next_check_ = 0, last_check_ = 0;
  Real known_stiffness_ = 0;             ///< demand at the last estimate, which contains it
  std::optional<StepFailure> rejected_;  ///< the last one, for messages
  bool warned_ = false;
  std::optional<std::string> warning_;
};

}  // namespace meniscus
