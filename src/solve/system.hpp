// SPDX-License-Identifier: BSD-3-Clause
// System: all that moves and all that acts, bodies and force terms.
#pragma once
#include "body/body.hpp"
#include "meniscus/error.hpp"
#include "physics/director/carried_field.hpp"
#include "physics/rank_reports.hpp"
#include "solve/constraints.hpp"
#include "solve/state.hpp"

#include <deque>
#include <memory>

namespace meniscus {

/// Bodies, the terms that act on them, and the masses of all particles.
template <int D>
struct System {
  std::deque<Body<D>> bodies;
  std::vector<std::unique_ptr<ForceTerm>> terms;
  std::vector<Real> mass;       ///< of all particles, bodies one after the other
  std::vector<Unknown> fields;  ///< unknowns beside the displacement, as a run begins with them
  std::vector<std::unique_ptr<CarriedField>> carried;  ///< those of them that bodies carry
  std::unique_ptr<Constraints> constraints;            ///< null: no place is prescribed

  /// Of a run of several ranks, in steps that need no more; null: steps are made on all particles.
  std::shared_ptr<Halo> halo = {};

  Index size() const { return static_cast<Index>(mass.size()); }
  /// An unknown field that begins at zero; returns its number in Motion and Forces. One that is
  /// asked for twice is the same field, with the sum of both capacities; throws std::logic_error if
  /// it is not described in the same way.
  std::size_t add_field(const FieldSpec& spec, std::span<const Real> capacity);

  /// Prescribes displacements, once all bodies have their masses; `state` gets its reactions.
  /// Throws as Constraints.
  void hold(std::vector<std::unique_ptr<Constraint>> all, State& state);
  /// Of the constraints, in a step of dt: places after the drift, and reactions at its end.
  void constrain(State& state, Real dt) {
    if (constraints) constraints->constrain(state, dt);
  }
  void react(State& state, Real dt) {
    if (constraints) constraints->react(state, dt);
  }
  /// Of the carried fields, in a step of dt: before the drift, and where it has led.
  void depart(const State& state) {
    for (auto& field : carried) field->depart(state.u);
  }
  void arrive(State& state, Real dt) {
    for (auto& field : carried)
      state.books.dissipated += field->arrive(state.u, dt, at(state.fields, field->number()).x);
  }
  /// From when on nothing but the motion changes forces and prescribed places.
  Real steady_after() const;

  /// From now on steps are made on what this rank follows, if all terms know what that is and some
  /// rank needs less than all. `reads`: of the stepper. All ranks call this, with a complete state.
  void share_steps(StepReads reads);
  /// Whether a term has come to read other particles than when steps were shared.
  bool reads_changed() const;
  /// Before steps of that kind, and where more is asked for than they know. All ranks call these.
  void enter_halo(State& state) {
    if (halo) halo->enter({&state.u, &state.v, &state.force});
  }
  void complete(State& state);
  bool in_halo() const { return is_entered(halo); }
  /// After terms have added to `sums`, [particle]: brings them to all that follow a particle.
  void spread(std::span<NodalVector> sums) const {
    if (in_halo()) halo->spread(sums);
  }
  /// Calls f(begin, end) for all particles, those that are followed in a step.
  template <class F>
  void for_particles(F&& f) const {
    meniscus::for_particles(halo, size(), f);
  }
  /// parallel_sum() over all particles.
  template <class T, class F>
  T sum_over_particles(T zero, F&& f) const {
    return meniscus::sum_over_particles(halo, size(), zero, f);
  }

  bool viscous() const;
  std::size_t bytes() const;  ///< held by terms and constraints

  /// Forces of all terms. Throws StepError with body, particle, place and cause where a term cannot
  /// compute one (J <= 0) or a force is not a number; `force` is then not to be used.
  Report compute_forces(const Motion& motion, Forces force);

  /// Same, without the checks: for trial motions of the time-step estimate.
  Report add_up(const Motion& motion, Forces force);

  /// Of all terms.
  Real load_power(const Motion& motion);
  void commit(const Motion& motion);

  /// A failure with body and place of its particle.
  StepFailure located(const Failure& failure, const Motion& motion) const;
  /// The body that holds a particle.
  const Body<D>& body_of(Index particle) const;

 private:
  /// Brings the reports of all terms what other ranks say.
  void complete_reports(const Motion& motion, Forces force);
  Index first_not_finite(std::span<const NodalVector> force) const;

  std::vector<Report> reports_;      // of the last call, [term]
  std::vector<ChunkReports*> left_;  // by reports
  ReportExchange exchange_;
  RankReports of_ranks_;
};

}  // namespace meniscus
