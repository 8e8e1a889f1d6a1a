// SPDX-License-Identifier: BSD-3-Clause
// System: all bodies and all force terms of a scene.
#pragma once
#include "body/body.hpp"
#include "meniscus/error.hpp"
#include "physics/director/carried_field.hpp"
#include "physics/rank_reports.hpp"
#include "solve/constraints.hpp"
#include "solve/state.hpp"

#include <deque>
#include <memory>
#include <string>

namespace meniscus {

/// Bodies, the terms that act on them, and the masses of all particles.
template <int D>
struct System {
  std::deque<Body<D>> bodies;
  std::vector<std::unique_ptr<ForceTerm>> terms;
  std::vector<Real> mass;       ///< [particle], one body after the other
  std::vector<Unknown> fields;  ///< unknowns beside the displacement, with their initial values
  std::vector<std::unique_ptr<CarriedField>> carried;  ///< fields of Evolution::carried
  std::unique_ptr<Constraints> constraints;            ///< null: no displacement is prescribed

  /// Halo for steps on several ranks. Null if steps are made on all particles.
  std::shared_ptr<Halo> halo = {};
  /// The reason why there is no halo, e.g. the name of a term; empty if there is a halo.
  std::string without_halo = {};

  Index size() const { return static_cast<Index>(mass.size()); }
  /// Adds an unknown field with initial value zero; returns its number in Motion and Forces. If two
  /// terms add the same field, it has the sum of their capacities. Throws std::logic_error if their
  /// descriptions differ.
  std::size_t add_field(const FieldSpec& spec, std::span<const Real> capacity);

  /// Sets the constraints when all bodies have their masses. Allocates the reactions of `state`.
  /// Throws like Constraints.
  void hold(std::vector<std::unique_ptr<Constraint>> all, State& state);
  /// Apply the constraints in a step of dt: constrain() after the drift, react() at the end.
  void constrain(State& state, Real dt) {
    if (constraints) constraints->constrain(state, dt);
  }
  void react(State& state, Real dt) {
    if (constraints) constraints->react(state, dt);
  }
  /// Advance the carried fields in a step of dt: depart() before the drift, arrive() after it.
  void depart(const State& state) {
    for (auto& field : carried) field->depart(state.u);
  }
  void arrive(State& state, Real dt) {
    for (auto& field : carried)
      state.books.dissipated += field->arrive(state.u, dt, at(state.fields, field->number()).x);
  }
  /// The time after which forces and prescribed displacements depend on the motion only.
  Real steady_after() const;

  /// Makes a halo for the next steps, if all terms can register their reads and some rank needs
  /// less than all particles. `reads` has the reads of the stepper. All ranks call this, with a
  /// complete state.
  void share_steps(StepReads reads);
  /// True if a term reads other particles than at the last share_steps().
  bool reads_changed() const;
  /// Enter and leave the halo: enter_halo() before steps, complete() before other particles are
  /// read. All ranks call these.
  void enter_halo(State& state) {
    if (halo) halo->enter({&state.u, &state.v, &state.force});
  }
  void complete(State& state);
  bool in_halo() const { return is_entered(halo); }
  /// Call this after terms have added to `sums`, [particle]: sends the sums to all ranks that
  /// follow a particle.
  void spread(std::span<NodalVector> sums) const {
    if (in_halo()) halo->spread(sums);
  }
  /// Calls f(begin, end) for ranges of all particles; in a halo, of the own and ghost particles.
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
  std::size_t bytes() const;  ///< memory of terms and constraints

  /// Computes the forces of all terms. Throws StepError with body, particle, position and cause if
  /// a term fails (J <= 0) or a force is NaN or infinite; `force` is then invalid.
  Report compute_forces(const Motion& motion, Forces force);

  /// Like compute_forces() without the checks, for trial motions.
  Report add_up(const Motion& motion, Forces force);

  /// Call load_power() and commit() of all terms.
  Real load_power(const Motion& motion);
  void commit(const Motion& motion);

  /// Describes a failure with the body and position of its particle.
  StepFailure located(const Failure& failure, const Motion& motion) const;
  /// The body that holds a particle.
  const Body<D>& body_of(Index particle) const;

 private:
  /// Adds the results of all ranks to the reports of all terms.
  void complete_reports(const Motion& motion, Forces force);
  Index first_not_finite(std::span<const NodalVector> force) const;

  std::vector<Report> reports_;      // [term] of the last call
  std::vector<ChunkReports*> left_;  // work space
  ReportExchange exchange_;
  RankReports of_ranks_;
};

}  // namespace meniscus
