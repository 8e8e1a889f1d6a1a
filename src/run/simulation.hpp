// SPDX-License-Identifier: BSD-3-Clause
// A running scene: state, step control and audit, and their snapshot.
#pragma once
#include "meniscus/solve/stepper.hpp"
#include "scene/scene.hpp"
#include "solve/audit.hpp"
#include "solve/step/step_controller.hpp"

#include <functional>
#include <optional>

namespace meniscus {

/// The D components of a nodal field, without padding.
template <int D>
std::vector<Real> packed(const NodalVectors& field);

template <int D>
class Simulation {
 public:
  /// `scene` must outlive the simulation. Throws InputError if the stepper cannot run this scene.
  explicit Simulation(Scene<D>& scene);

  /// Computes the forces, the stable step and the audit of the initial state. Throws like
  /// StepController::begin.
  void begin();
  /// Moves to the first state that is shown. With `newton` this is the equilibrium at the start
  /// time; otherwise the initial state itself. If this is not called, the first step begins with
  /// it. Throws like advance().
  void settle();
  /// Continues `before`, a simulation of the same scene with other references of its bodies.
  /// `state` is the state of `before`, transferred to this scene. The history of force terms, the
  /// books and the audit are taken from `before`. The change of energy due to the remap is booked
  /// as `remapped`. Throws like begin().
  void begin_after(Simulation& before, State state);
  /// Continues a state of this scene from before force terms were added to it. Throws like begin().
  void begin_with_new_terms(const Snapshot& before);
  /// Makes one step towards the end of the scene. A rejected step is undone and halved, several
  /// times if needed. Throws StepError; the state then has the positions before the step, but is
  /// incomplete.
  void advance();

  /// Moves to the equilibrium near the one of `base`, a simulation of the same scene with slightly
  /// other numbers, by Newton's method with the tangent of `base` (quasi-statics note 11). Throws
  /// InputError if the scene has other particles or the stepper of `base` finds no equilibria of
  /// solids, and SolveError if there is no equilibrium near, or that of `base` is not stable.
  void follow(Simulation& base);

  /// From now on long steps stop when asked() returns true. settle() and advance() then throw
  /// Interrupted, and the state is bitwise as before the call.
  void stop_when(const std::function<bool()>& asked);

  /// True if the end time or the required state of rest is reached, or if it cannot be reached any
  /// more.
  bool finished() const;

  const Scene<D>& scene() const { return scene_; }
  /// The current state. Between steps of a run on several ranks, positions and velocities may be
  /// valid only for the own and ghost particles of this rank; see complete_state().
  const State& state() const { return state_; }
  /// Gathers the state of all particles on all ranks. All ranks call this.
  void complete_state() { scene_.system.complete(state_); }
  Real last_step() const { return last_step_; }
  StepController<D>& controller() { return *controller_; }
  const Audit& audit() const { return audit_; }
  const Stepper<D>& stepper() const { return *stepper_; }
  /// Sentences for the log about begin() and about the steps since the last call.
  std::vector<std::string> take_notes();
  /// The ledger of the present state; also widens the scales of the audit. Throws SolveError for an
  /// impossible state: a failed check of the scene, or a drop with an isoperimetric ratio below 1 -
  /// 1e-3.
  Ledger audit_now();

  /// All values that determine how the run continues, bit for bit.
  Snapshot snapshot();
  /// Like snapshot(), on rank 0, which writes it. Other ranks get an empty snapshot, which saves
  /// memory. All ranks call this.
  Snapshot snapshot_of_first_rank();
  /// Restores a snapshot. Throws FileError if it belongs to another scene.
  void restore(const Snapshot& snapshot);

 private:
  void archive(const Archive& a);
  /// Makes the present energies and momenta the zero of the audit.
  void begin_audit();
  /// Makes the stepper and its step control. Throws InputError if the stepper cannot run this
  /// scene.
  void make_stepper(bool implicit_viscosity);
  void share_steps();
  void choose_viscosity();
  void archive_viscosity(const Archive& a);
  void archive_terms(const Archive& a);
  void archive_references(const Archive& a) const;
  void step_or_halve(Real dt);
  void refuse_impossible_states();
  void refuse(const StateCheck& check) const;
  bool surfaces_due() const;
  void refuse_impossible_surfaces() const;
  [[noreturn]] void give_up(StepFailure failure);
  /// Calls `work`. Adds the step and the time to failures. If `work` is interrupted, restores
  /// everything.
  template <class Work>
  void or_give_up(const Work& work);

  Scene<D>& scene_;
  State state_;
  State before_;  // state before the step, if a term may reject the step
  bool keeps_state_before_;
  bool may_be_interrupted_ = false;
  bool implicit_viscosity_ = false;
  std::optional<StepController<D>> controller_;
  std::unique_ptr<Stepper<D>> stepper_;
  std::vector<std::string> notes_;
  Audit audit_;
  Real last_step_ = 0;
  std::optional<Real> possible_at_;  // time of the last state that passed all checks
  std::int64_t surfaces_seen_ = -1;  // step of the last check of all surfaces; -1: none
};

}  // namespace meniscus
