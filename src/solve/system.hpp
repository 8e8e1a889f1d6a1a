// SPDX-License-Identifier: BSD-3-Clause
// System: all bodies and all force terms of a scene.
#pragma once
#include "body/body.hpp"
#include "meniscus/error.hpp"
#include "parallel/followed_particles.hpp"
#include "physics/director/carried_field.hpp"
#include "physics/force_phases.hpp"
#include "solve/constraints.hpp"
#include "solve/state.hpp"

#include <deque>
#include <functional>
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

  FollowedParticles followed;  ///< by steps on several processes

  Index size() const { return static_cast<Index>(mass.size()); }
  /// True if the bodies are of revolution. They can move along the axis (y) only as rigid bodies.
  bool revolved() const { return !bodies.empty() && bodies.front().geometry.grid.revolved; }
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

  /// Divides the next steps between processes, if the reads of all terms are known. `reads` has the
  /// reads of the stepper. All processes call this, with a complete state.
  void share_steps(StepReads reads);
  /// True if a term reads other particles than at the last share_steps().
  bool reads_changed() const;
  /// Begin and end steps on followed particles: follow() before steps, complete() before other
  /// particles are read. All processes call these.
  void follow(State& state) { followed.enter({&state.u, &state.v, &state.force}); }
  void complete(State& state) { followed.leave({&state.u, &state.v, &state.force}); }
  /// Calls f(begin, end) for ranges of all followed particles.
  template <class F>
  void for_particles(F&& f) const {
    followed.for_each(size(), f);
  }
  /// Sum over all particles.
  template <class T, class F>
  T sum_over_particles(T zero, F&& f) const {
    return followed.sum(size(), zero, f);
  }
  /// Sum over the particles of a body.
  template <class T, class F>
  T sum_over_particles(const Body<D>& body, T zero, F&& f) const {
    return followed.sum_part(size(), {body.first, body.first + body.size()}, zero, f);
  }

  bool viscous() const;
  std::size_t bytes() const;  ///< memory of terms and constraints

  /// Computes the forces of all terms. Throws StepError with body, particle, position and cause if
  /// a term fails (J <= 0) or a force is NaN or infinite; `force` is then invalid.
  Report compute_forces(const Motion& motion, Forces force);

  /// Like compute_forces() without the checks and Report::demand, for trial motions.
  Report add_up(const Motion& motion, Forces force);
  /// force += the force of one term.
  Report add_force(ForceTerm& term, const Motion& motion, Forces force);
  /// force += the tangents of all terms, or of those for which wanted(term).
  using Wanted = bool (*)(const ForceTerm&);
  static bool every(const ForceTerm&) { return true; }
  static bool viscous(const ForceTerm& term) { return term.viscous(); }
  void add_tangent(const Motion& motion, const Motion& change, Forces force, Wanted wanted = every);
  /// force += what add(force) adds, of rows of this process.
  void add_by(const Motion& motion, Forces force, const std::function<void(const Forces&)>& add);
  /// Add what ForceTerm::add_viscous() and add_viscous_diagonal() of all viscous terms add.
  void add_viscous(const Motion& motion, Forces force);
  void add_viscous_diagonal(std::span<NodalVector> diagonal);

  /// Call load_power() and commit() of all terms.
  Real load_power(const Motion& motion);
  void commit(const Motion& motion);

  /// Describes a failure with the body and position of its particle.
  StepFailure located(const Failure& failure, const Motion& motion) const;
  /// The body that holds a particle.
  const Body<D>& body_of(Index particle) const;

 private:
  Report add_up_for(bool demand, const Motion& motion, Forces force);
  /// Runs work(force) between the begin and the end of the phases at a motion.
  template <class F>
  void in_phases(const Motion& motion, Forces force, F&& work);
  /// Runs add(term, force) of wanted terms in phases.
  template <class F>
  void for_terms(const Motion& motion, Forces force, Wanted wanted, F&& add);
  /// Sends forces to all processes that follow a particle.
  void spread(Forces force);
  /// Brings the failures of reports, known to the process that has the row, to all processes.
  void share_failures();
  Index first_not_finite(std::span<const NodalVector> force) const;
  ParticleOwners particle_owners() const;

  std::vector<Report> reports_;  // [term] of the last call
  ForcePhases phases_;
  ForcePhases::Everywhere everywhere_;
  NodalVectors all_u_, all_v_;  // of everywhere_
};

}  // namespace meniscus
