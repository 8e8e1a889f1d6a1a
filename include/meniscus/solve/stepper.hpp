// SPDX-License-Identifier: BSD-3-Clause
// Steppers: the ways in which a state goes on from step to step. Each is one file that registers
// itself under the name by which [time] solver chooses it.
#pragma once
#include "input/registry.hpp"
#include "solve/system.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace meniscus {

/// How far a state is from what a stepper looks for.
struct Residual {
  std::string meaning;  ///< e.g. "force residual"
  Real value;
  std::optional<Real> allowed;  ///< none: it is not judged
};

template <int D>
class Stepper {
 public:
  virtual ~Stepper() = default;

  /// A run begins, or a run of another stepper goes on, at `state`, which has its forces.
  virtual void begin(const State&) {}
  /// Takes the state at which a run begins to one that can be shown, at the same time. Throws as
  /// step().
  virtual void settle(State&) {}
  /// The longest step that is accurate enough, at a state that has its forces.
  virtual Real longest_step(const State&) { return unbounded; }
  /// Whether no step is too long to be stable: longest_step() is then the step itself, and nobody
  /// looks for the stable one.
  virtual bool implicit() const { return false; }
  /// Whether longest_step() is the step itself, for this reason or since it finds a stable one.
  virtual bool chooses_step() const { return implicit(); }
  /// From state.time to state.time + dt. Throws as advance().
  virtual void step(State& state, Real dt) = 0;
  /// The same, but throws a StepError `of_step` where a shorter step is called for. The state is
  /// then to be taken back by the caller.
  virtual void try_step(State& state, Real dt) { step(state, dt); }
  /// Whether try_step() may ask for a shorter step.
  virtual bool may_reject_steps() const { return false; }

  /// Of a run of several ranks: says what step() reads of the motion beside what forces and sums
  /// over all particles read (System::share_steps()). False: it may be that of all particles.
  virtual bool tell_reads(StepReads&) { return false; }

  /// A step that takes long asks now and then whether to stop, and then throws Interrupted. What
  /// the stepper knows of the past is then to be restored by the caller.
  virtual void stop_when(const std::function<bool()>&) {}

  /// Whether the state that the stepper looks for is reached, so that the run ends.
  virtual bool arrived() const { return false; }
  /// Of the present state, in the order of StepperEntry::residuals; none if it looks for nothing.
  virtual std::vector<Residual> residuals(const State&) const { return {}; }
  /// Whether it cannot be reached any more, so that the run ends; obstacle() says why.
  virtual bool blocked() const { return false; }
  /// What may keep the stepper from arriving; empty if it sees nothing.
  virtual std::string obstacle(const State&) const { return ""; }

  /// What the log should say of the steps since it was asked last.
  virtual std::vector<std::string> take_notes() { return {}; }
  /// What the steps took beside forces, for the end of the log; empty if nothing.
  virtual std::string effort() const { return ""; }

  /// Keeps what decides how the run goes on; `state` is that of the archive.
  virtual void archive(const Archive&, const State&) {}

  /// At the state at which the stepper has arrived: the least stiffness of the equilibrium relative
  /// to that of linear elements, negative if it is not stable; none where that is not known.
  virtual std::optional<Real> stability(const State&) const { return {}; }
};

/// What a scene says to its stepper.
struct StepperChoice {
  Real end = 0;                                   ///< of the run
  Real force_tolerance = 0, shape_tolerance = 0;  ///< of Relaxation
  std::vector<bool> fluid = {};                   ///< which bodies are fluids; empty: none
  bool implicit_viscosity = false;                ///< of Dynamics
  std::optional<Real> step = {};                  ///< given in the scene
  std::string place = {};                         ///< of the choice, to begin a message with
  Real safety = 0.9;                              ///< steps / the longest stable one

  /// That given, or a twentieth of the run.
  Real load_step() const { return step.value_or(end / 20); }
};

/// Whether a step from `time` meets `end`, but for round-off.
inline bool reaches(Real time, Real step, Real end) {
  return end - time <= step * (1 + 1e-9);
}

struct StepperEntry {
  static constexpr const char* kind = "solver";
  std::string name;
  std::vector<std::string> residuals;  ///< their columns in the history
  // Throw InputError if the stepper cannot do what the system asks.
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
