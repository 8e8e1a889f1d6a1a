// SPDX-License-Identifier: BSD-3-Clause
// Steppers: methods that advance a state step by step. Each is one file and registers itself under
// its name in [time] solver.
#pragma once
#include "input/registry.hpp"
#include "solve/system.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace meniscus {

/// A measure of the distance of a state from the goal of a stepper.
struct Residual {
  std::string meaning;  ///< e.g. "force residual"
  Real value;
  std::optional<Real> allowed;  ///< empty: the residual is not judged
};

template <int D>
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// Called when a run begins, or continues from another stepper, at `state`, which has its forces.
  virtual void begin(const State&) {}
  /// Moves the first state of a run to a state that can be shown, at the same time. Throws like
  /// step().
  virtual void settle(State&) {}
  /// The longest step that is accurate enough, at a state that has its forces.
  virtual Real longest_step(const State&) { return unbounded; }
  /// True if steps of any length are stable. longest_step() is then the step itself, and the stable
  /// step is not estimated.
  virtual bool implicit() const { return false; }
  /// True if longest_step() is the step itself, because the stepper is implicit or finds a stable
  /// step.
  virtual bool chooses_step() const { return implicit(); }
  /// Advances the state from state.time to state.time + dt. Throws like advance().
  virtual void step(State& state, Real dt) = 0;
  /// Like step(), but throws a StepError `of_step` if a shorter step is needed. The caller then
  /// restores the state.
  virtual void try_step(State& state, Real dt) { step(state, dt); }
  /// True if try_step() may reject a step.
  virtual bool may_reject_steps() const { return false; }

  /// Registers the particles whose motion step() reads in addition to forces and sums over all
  /// particles. Returns false if it may read any particle: then each process follows the motion of
  /// all particles.
  virtual bool reads(StepReads&) { return false; }

  /// During a long step, the given function is called now and then. If it returns true, the step
  /// throws Interrupted, and the caller restores the stepper.
  virtual void stop_when(const std::function<bool()>&) {}

  /// True if the goal of the stepper is reached; the run then ends.
  virtual bool arrived() const { return false; }
  /// Residuals of the present state, in the order of StepperEntry::residuals. Empty if the stepper
  /// has no goal.
  virtual std::vector<Residual> residuals(const State&) const { return {}; }
  /// True if the goal cannot be reached any more. The run then ends; obstacle() gives the reason.
  virtual bool blocked() const { return false; }
  /// Description of an obstacle to reaching the goal; empty if there is none.
  virtual std::string obstacle(const State&) const { return ""; }

  /// How far a long step has come, for the progress of a run; empty if steps are short. Called by
  /// the function given to stop_when().
  virtual std::string doing() const { return ""; }
  /// Sentences for the log about the steps since the last call.
  virtual std::vector<std::string> take_notes() { return {}; }
  /// Effort of the steps besides forces, for the end of the log; may be empty.
  virtual std::string effort() const { return ""; }

  /// The change of the displacement coefficients of the equilibrium `state` by small forces, to
  /// first order. Empty if the stepper finds no equilibria of solids. Throws SolveError if the
  /// equilibrium is not stable.
  virtual std::optional<NodalVectors> response(const State& /*state*/,
                                               const NodalVectors& /*force*/) {
    return {};
  }

  /// Saves or restores the values that determine how the run continues. `state` is the state in the
  /// same archive.
  virtual void archive(const Archive&, const State&) {}

  /// Call this when the stepper has arrived. Smallest stiffness of the equilibrium, relative to
  /// linear elements; negative if the equilibrium is unstable. Empty if it is not known.
  virtual std::optional<Real> stability(const State&) const { return {}; }
};

/// Settings of a scene for its stepper.
struct StepperChoice {
  Real end = 0;                                   ///< end time of the run
  Real force_tolerance = 0, shape_tolerance = 0;  ///< of Relaxation
  std::vector<bool> fluid = {};                   ///< [body] true for fluids; empty: none
  bool implicit_viscosity = false;                ///< of Dynamics
  std::optional<Real> step = {};                  ///< fixed step of the scene
  std::string place = {};                         ///< place of `solver` in the scene, for messages
  Real safety = 0.9;                              ///< steps / the longest stable one

  /// The fixed step, or a twentieth of the run.
  Real load_step() const { return step.value_or(end / 20); }
};

/// True if a step from `time` reaches `end`, up to round-off.
inline bool reaches(Real time, Real step, Real end) {
  return end - time <= step * (1 + 1e-9);
}

struct StepperEntry {
  static constexpr const char* kind = "solver";
  std::string name;
  std::vector<std::string> residuals;  ///< names of their columns in the history
  // Make the stepper. Throw InputError if it cannot run this system.
  std::unique_ptr<Stepper<2>> (*make_2d)(System<2>&, const StepperChoice&);
  std::unique_ptr<Stepper<3>> (*make_3d)(System<3>&, const StepperChoice&);

  template <int D>
  std::unique_ptr<Stepper<D>> make(System<D>& system, const StepperChoice& choice) const {
    if constexpr (D == 2)
      return make_2d(system, choice);
    else
      return make_3d(system, choice);
  }
};

}  // namespace meniscus
