// SPDX-License-Identifier: BSD-3-Clause
// Starts, advances, saves and restores a run.
#include "run/simulation.hpp"

#include "measure/drop_measures.hpp"
#include "meniscus/error.hpp"
#include "parallel/nodal_algebra.hpp"
#include "parallel/ranks.hpp"
#include "solve/step/central_difference.hpp"
#include "solve/step/viscosity_choice.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

namespace meniscus {

template <int D>
std::vector<Real> packed(const NodalVectors& field) {
  std::vector<Real> values;
  values.reserve(field.size() * D);
  for (const NodalVector& x : field)
    for (int i = 0; i < D; ++i) values.push_back(x[i]);
  return values;
}

namespace {

template <int D>
StepperChoice stepper_choice(const Scene<D>& scene, bool implicit_viscosity) {
  StepperChoice choice{scene.time.end,
                       scene.time.force_tolerance,
                       scene.time.shape_tolerance,
                       {},
                       implicit_viscosity,
                       scene.time.step,
                       scene.time.solver_place,
                       scene.time.safety};
  if (choice.implicit_viscosity && !scene.system.viscous())
    throw InputError(scene.time.viscosity_place +
                     ": implicit viscosity is for scenes with a viscous fluid, this has none; "
                     "leave the key out");
  for (const SceneBody& body : scene.bodies) choice.fluid.push_back(body.is_fluid());
  return choice;
}

/// Copies the state. All threads share the copying of the large arrays.
template <int D>
void keep(const System<D>& system, State& state, State& copy) {
  constexpr std::array large{&State::u, &State::v, &State::force};
  std::array<NodalVectors, large.size()> of_state, of_copy;
  for (std::size_t k = 0; k < large.size(); ++k) {
    at(of_state, k) = std::move(state.*at(large, k));
    at(of_copy, k) = std::move(copy.*at(large, k));
    at(of_copy, k).resize(at(of_state, k).size());
  }
  copy = state;
  copy.energies.reserve(state.energies.capacity());
  for (std::size_t k = 0; k < large.size(); ++k) {
    state.*at(large, k) = std::move(at(of_state, k));
    copy.*at(large, k) = std::move(at(of_copy, k));
  }
  system.for_particles([&](Index begin, Index end) {
    for (const auto vector : large)
      std::copy((state.*vector).begin() + begin, (state.*vector).begin() + end,
                (copy.*vector).begin() + begin);
  });
}

}  // namespace

template <int D>
Simulation<D>::Simulation(Scene<D>& scene)
    : scene_(scene),
      state_(scene.initial),
      keeps_state_before_(std::any_of(
          scene.system.terms.begin(), scene.system.terms.end(),
          [](const std::unique_ptr<ForceTerm>& term) { return term->may_reject_steps(); })) {
  make_stepper(scene.time.viscosity == "implicit");
  keeps_state_before_ |= !scene.time.step && stepper_->may_reject_steps();
}

template <int D>
void Simulation<D>::make_stepper(bool implicit_viscosity) {
  const TimeSettings& time = scene_.time;
  implicit_viscosity_ = implicit_viscosity;
  controller_.emplace(scene_.system,
                      typename StepController<D>::Choice{time.step, time.safety, time.check_every,
                                                         time.step_place, implicit_viscosity});
  stepper_ = Registry<StepperEntry>::all()
                 .at(time.solver)
                 .make(scene_.system, stepper_choice(scene_, implicit_viscosity));
  share_steps();
}

/// Divides steps between ranks, if the stepper and all terms report the particles that they read.
/// The state must be complete on all ranks.
template <int D>
void Simulation<D>::share_steps() {
  StepReads reads(scene_.system.size());
  if (!stepper_->chooses_step()) controller_->list_reads(reads);
  if (stepper_->reads(reads))
    scene_.system.share_steps(std::move(reads));
  else
    scene_.system.followed.follow_all("solver = \"" + scene_.time.solver + "\"");
}

/// If the scene leaves the viscosity automatic, chooses explicit or implicit for the present state.
template <int D>
void Simulation<D>::choose_viscosity() {
  if (scene_.time.viscosity != "automatic") return;
  const ViscosityChoice choice =
      meniscus::choose_viscosity(scene_.system, state_, scene_.time.step);
  notes_.push_back(choice.reason);
  if (choice.implicit != implicit_viscosity_) make_stepper(choice.implicit);
}

template <int D>
std::vector<std::string> Simulation<D>::take_notes() {
  std::vector<std::string> notes = std::exchange(notes_, {});
  for (std::string& note : stepper_->take_notes()) notes.push_back(std::move(note));
  return notes;
}

template <int D>
void Simulation<D>::begin() {
  start(scene_.system, state_);
  choose_viscosity();
  if (stepper_->implicit())  // the solution has no motion
    std::fill(state_.v.begin(), state_.v.end(), Lanes::zero());
  if (!stepper_->chooses_step()) controller_->begin(state_);
  begin_audit();
  stepper_->begin(state_);
}

template <int D>
void Simulation<D>::begin_audit() {
  const Ledger ledger = take_ledger(scene_.system, state_);
  state_.books.momentum = ledger.momentum;
  state_.books.angular_momentum = ledger.angular_momentum;
  audit_.begin(ledger);
}

template <int D>
void Simulation<D>::begin_after(Simulation& before, State state) {
  Snapshot history;
  before.archive_terms(Archive::writing(history));
  archive_terms(Archive::reading(history));
  if (implicit_viscosity_ != before.implicit_viscosity_) make_stepper(before.implicit_viscosity_);
  state_ = std::move(state);
  ++state_.epoch;
  last_step_ = before.last_step_;
  possible_at_ = before.possible_at_;
  surfaces_seen_ = before.surfaces_seen_;
  start(scene_.system, state_);
  state_.books.remap(take_ledger(scene_.system, state_).balance() -
                     take_ledger(before.scene_.system, before.state_).balance());
  if (!stepper_->chooses_step()) controller_->begin(state_);
  audit_ = before.audit_;
  stepper_->begin(state_);
}

template <int D>
void Simulation<D>::begin_with_new_terms(const Snapshot& before) {
  restore(before);
  start(scene_.system, state_);
  if (!stepper_->chooses_step()) controller_->begin(state_);
  stepper_->begin(state_);
}

template <int D>
bool Simulation<D>::finished() const {
  return state_.time >= scene_.time.end || stepper_->arrived() || stepper_->blocked();
}

/// Makes a step of dt. If the step is rejected, it is halved and tried again. After six halvings
/// the step is made unchecked, because an impact exceeds the limits at any step.
template <int D>
void Simulation<D>::step_or_halve(Real dt) {
  constexpr int most_halvings = 6;
  keep(scene_.system, state_, before_);
  StepFailure rejected;
  for (int halvings = 0;; ++halvings) {
    last_step_ = dt;
    try {
      if (halvings == most_halvings || scene_.time.step)
        stepper_->step(state_, dt);
      else
        stepper_->try_step(state_, dt);
      if (halvings > 0) controller_->shorten(dt, rejected);
      return;
    } catch (StepError& e) {
      e.failure.halvings = halvings;
      if (!e.failure.of_step || halvings == most_halvings) throw;
      state_ = before_;
      rejected = e.failure;
      dt /= 2;
    }
  }
}

template <int D>
void Simulation<D>::settle() {
  or_give_up([&] { stepper_->settle(state_); });
}

template <int D>
void Simulation<D>::advance() {
  or_give_up([&] {
    const Real longest = stepper_->longest_step(state_);
    last_step_ = stepper_->chooses_step() ? std::min(longest, scene_.time.end - state_.time)
                                          : controller_->next(state_, scene_.time.end, longest);
    state_.energies_asked =
        !stepper_->implicit() &&  // whose last forces need not be those of the state it finds
        scene_.output.record_due(state_.time, state_.time + last_step_, scene_.time.end);
    if (scene_.system.reads_changed()) {
      complete_state();
      share_steps();
    }
    scene_.system.follow(state_);
    if (keeps_state_before_)
      step_or_halve(last_step_);
    else
      stepper_->step(state_, last_step_);
  });
}

template <int D>
void Simulation<D>::stop_when(const std::function<bool()>& asked) {
  stepper_->stop_when(asked);
  may_be_interrupted_ = stepper_->implicit();
}

template <int D>
template <class Work>
void Simulation<D>::or_give_up(const Work& work) {
  std::optional<Snapshot> before;
  if (may_be_interrupted_) before = snapshot();
  try {
    work();
  } catch (const Interrupted&) {
    restore(before.value());
    throw;
  } catch (const StepError& e) {
    give_up(e.failure);
  } catch (const SolveError& e) {
    StepFailure failure;
    failure.cause = e.what();
    give_up(failure);
  }
}

template <int D>
void Simulation<D>::refuse_impossible_states() {
  for (const StateCheck& check : scene_.checks) refuse(check);
  refuse_impossible_surfaces();
  if (!surfaces_due()) return;
  refuse(scene_.surfaces);
  surfaces_seen_ = state_.step;
  possible_at_ = state_.time;
}

/// True if the surfaces must be checked now. Checks are rare enough to take less than a hundredth
/// of the time of steps.
template <int D>
bool Simulation<D>::surfaces_due() const {
  constexpr std::int64_t between = 50;
  return surfaces_seen_ < 0 || finished() || stepper_->implicit() ||
         state_.step >= surfaces_seen_ + between;
}

template <int D>
void Simulation<D>::refuse(const StateCheck& check) const {
  const auto found = check(state_.motion());
  if (!found) return;
  StepFailure failure = scene_.system.located(*found, state_.motion());
  if (possible_at_) failure.cause += fmt::format("; this was not so at t = {:.9g}", *possible_at_);
  failure.step = state_.step;
  failure.time = state_.time;
  failure.dt = last_step_;
  throw StepError(failure);
}

/// Throws SolveError if a surface is smaller than the surface of a ball (2D: disk) of the same
/// volume. This is impossible and means that the quadrature no longer resolves the shape.
template <int D>
void Simulation<D>::refuse_impossible_surfaces() const {
  constexpr Real bearable = 1e-3;
  for (const std::size_t b : scene_.drops()) {
    const BodyTension& tension = *scene_.bodies[b].tension;
    const Real area = tension.area(state_.motion()), volume = tension.volume(state_.motion());
    const int space = scene_.system.bodies[b].space();
    const Real ratio = isoperimetric_ratio(area, volume, space);
    if (tension.inscribed() || ratio >= 1 - bearable) continue;
    refuse(scene_.surfaces);  // a crossing names the cause better
    throw SolveError(fmt::format(
        "step {}, t = {:.9g}: body '{}' has the isoperimetric ratio {:.6f}: the {} {:.6g} of its "
        "surface tension is below the least possible {:.6g} for its {}; the surface is no longer "
        "resolved; use form = \"balanced\", finer particles, or a reference shape nearer to the "
        "present one",
        state_.step, state_.time, scene_.system.bodies[b].name, ratio,
        space == 3 ? "area" : "circumference", area, area / ratio, space == 3 ? "volume" : "area"));
  }
}

template <int D>
void Simulation<D>::give_up(StepFailure failure) {
  if (ranks().all_come()) {  // otherwise this rank has failed alone
    complete_state();
    // The failed step left invalid forces. Compute the forces at the restored positions, so that
    // output can show them.
    scene_.system.add_up(state_.motion(), state_.forces());
  }
  failure.step = state_.step + 1;
  failure.time = state_.time + last_step_;
  failure.dt = last_step_;
  throw StepError(failure);
}

template <int D>
Ledger Simulation<D>::audit_now() {
  complete_state();
  refuse_impossible_states();
  const Ledger ledger = take_ledger(scene_.system, state_);
  audit_.follow(scene_.system, state_, ledger);
  return ledger;
}

template std::vector<Real> packed<2>(const NodalVectors&);
template std::vector<Real> packed<3>(const NodalVectors&);
template class Simulation<2>;
template class Simulation<3>;

}  // namespace meniscus
