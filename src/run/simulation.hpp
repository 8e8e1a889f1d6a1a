// SPDX-License-Identifier: BSD-3-Clause
// A scene in motion: state, step control and audit, and their snapshot.
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
  /// `scene` must outlive the simulation. Throws InputError if its stepper cannot do what it asks.
  explicit Simulation(Scene<D>& scene);

  /// Forces, stable step and audit at the initial state. Throws as StepController::begin.
  void begin();
  /// To the first state that can be shown: with `newton` the equilibrium at the start. Without it
  /// the first step begins with that. Throws as advance().
  void settle();
  /// Goes on in place of `before`, of the same scene with other references of its bodies, from its
  /// state carried over to them. The history of force terms, the books and the audit are those of
  /// before; the energy that has come by the change is booked as remapped. Throws as begin().
  void begin_after(Simulation& before, State state);
  /// One step towards the end of the scene; one that is rejected is taken back and halved, a few
  /// times. Throws StepError; the state is then back at the places before the step, but not
  /// complete.
  void advance();

  /// From now on steps that take long stop when they are asked to: settle() and advance() then
  /// throw Interrupted, and all is as it was before, bit for bit.
  void stop_when(const std::function<bool()>& asked);

  /// Whether the end of the scene, or the rest that it asks for, is reached.
  bool finished() const;

  const Scene<D>& scene() const { return scene_; }
  /// In a run of several ranks, between steps, places and velocities may be known to the ranks that
  /// need them only.
  const State& state() const { return state_; }
  /// Makes all known to all ranks. All ranks call this.
  void complete_state() { scene_.system.complete(state_); }
  Real last_step() const { return last_step_; }
  StepController<D>& controller() { return *controller_; }
  const Audit& audit() const { return audit_; }
  const Stepper<D>& stepper() const { return *stepper_; }
  /// What the log should say of begin() and of the steps since it was asked last.
  std::vector<std::string> take_notes();
  /// The ledger of now; widens the scales of the audit. Throws SolveError for a state that cannot
  /// be: what a check of the scene finds, or a drop that has lost its shape (an isoperimetric ratio
  /// below 1 - 1e-3).
  Ledger audit_now();

  /// Everything that decides how the run goes on, bit for bit.
  Snapshot snapshot();
  /// The same for the first rank of a run, which writes it; nothing for the others, so that they
  /// have no memory for it. All ranks call this.
  Snapshot snapshot_of_first_rank();
  /// Throws FileError if the snapshot is of another scene.
  void restore(const Snapshot& snapshot);

 private:
  void archive(const Archive& a);
  /// Energies and momenta are counted from those of the state of now.
  void begin_audit();
  /// Makes the stepper and its step control. Throws InputError as the stepper does.
  void make_stepper(bool implicit_viscosity);
  void share_steps();
  void choose_viscosity();
  void archive_viscosity(const Archive& a);
  void archive_terms(const Archive& a);
  void archive_references(const Archive& a) const;
  void archive_orders(const Archive& a) const;
  void step(Real dt);
  void step_or_halve(Real dt);
  void refuse_impossible_states();
  void refuse(const StateCheck& check) const;
  bool surfaces_due() const;
  void refuse_impossible_surfaces() const;
  [[noreturn]] void give_up(StepFailure failure);
  /// Failures of `work` get their step and time; of one that is interrupted nothing is left.
  template <class Work>
  void or_give_up(const Work& work);

  Scene<D>& scene_;
  State state_;
  State before_;  // the step, where a term may reject it
  bool keeps_state_before_;
  bool may_be_interrupted_ = false;
  bool implicit_viscosity_ = false;
  std::optional<StepController<D>> controller_;
  std::unique_ptr<Stepper<D>> stepper_;
  std::vector<std::string> notes_;
  Audit audit_;
  Real last_step_ = 0;
  std::optional<Real> possible_at_;  // time of the last state that passed all checks
  std::int64_t surfaces_seen_ = -1;  // step of the last look at all surfaces; -1: none
};

}  // namespace meniscus
