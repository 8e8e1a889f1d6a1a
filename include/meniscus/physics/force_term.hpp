// SPDX-License-Identifier: BSD-3-Clause
// The interface of all physical effects. A system is a list of force terms. If an effect is not
// named in the scene, it is not in the list and costs nothing.
#pragma once
#include "numbers/resultant.hpp"
#include "parallel/gathered.hpp"
#include "parallel/step_reads.hpp"
#include "physics/constraint.hpp"
#include "physics/unknown.hpp"
#include "state/archive.hpp"

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

class ForceTerm;

/// The arguments of forces: time, and the displacement and velocity coefficients of the particles
/// of all bodies.
struct Motion {
  Real time;
  std::span<const NodalVector> u, v;
  std::span<const Unknown> fields = {};  ///< numbered as by System::add_field
  const Reactions* reactions = nullptr;  ///< of the constraints; only measures use them
};

/// The value of stored_energy() of a term, when the term has computed it together with its force.
struct StoredEnergy {
  const ForceTerm* term;
  Real value;
};

struct Report;
class ForcePhases;

/// The forces on the displacement coefficients of all particles, and the fields, whose forces are
/// in Unknown::f.
struct Forces : ForceVector {
  /// The next phase of a force.
  using Then = std::function<Report(const Motion&, Forces)>;

  Forces(std::span<NodalVector> f, std::span<Unknown> unknowns = {})
      : ForceVector(f), fields(unknowns) {}
  Forces(NodalVectors& f) : ForceVector(f) {}

  std::span<Unknown> fields;
  /// Terms that get their stored energy as a by-product of the force add it here. Null if no
  /// energies are needed.
  std::vector<StoredEnergy>* energies = nullptr;
  /// If false, Report::demand is not needed.
  bool demand = true;
  /// The phases of all terms of a system. If null, the phases of one term follow each other.
  ForcePhases* phases = nullptr;

  /// The forces on a field.
  ForceVector of_field(std::size_t number) const { return {at(fields, number).f, pending}; }
  /// Ends a phase of a term. Goes on with then(motion, force) when these arrays are complete: each
  /// has been computed in shares. Returns the report of that phase, or an empty one if it runs
  /// later. The calls of a term must be the same on all processes.
  Report gather(std::span<const Gathered> arrays, const Motion& motion, Then then) const;
  Report gather(std::initializer_list<Gathered> arrays, const Motion& motion, Then then) const;
  /// The motion at all particles; `motion` may be known to the rows of a process only. The calls
  /// must be the same on all processes.
  Motion everywhere(const Motion& motion) const;
};

/// Reason why a term could not compute a valid force.
struct Failure {
  Index particle = -1;     ///< global number of the particle nearest to the failure
  std::string cause = {};  ///< e.g. "J = -0.3 at a stress point; F = [...]"
  bool of_step = false;    ///< a shorter step may avoid it
  std::string term = {};   ///< name of the term; the system fills it in
};

/// Limits for the next step until the stable step is estimated again. Only terms whose stiffness
/// can grow by multiples within few steps set limits.
struct StepDemand {
  Real stiffness = 0;  ///< squared frequencies added within the step, at most, 1/time^2
  Real longest = std::numeric_limits<Real>::max();  ///< longest step

  StepDemand& operator+=(const StepDemand& other) {
    stiffness += other.stiffness;
    longest = std::min(longest, other.longest);
    return *this;
  }
};

/// Results of add_force() besides the forces, for the same motion.
struct Report {
  Real heat = 0;  ///< power turned into heat
  /// Power supplied from outside by explicit dependence on time: ramps, and partners with a
  /// prescribed motion. The power of a load on the velocity is load_power() instead.
  Real external_power = 0;
  /// Work supplied from outside since the last accepted step by sources that may jump in time.
  Real external_work = 0;
  /// Energy turned into heat since the last accepted step by laws with a memory. It is not in
  /// `heat`.
  Real lost = 0;
  /// Net force and moment of loads from outside. A term whose forces should balance each other
  /// leaves this zero, so that the audit of the momenta detects forces that do not balance.
  Resultant outside = {};
  StepDemand demand = {};
  std::optional<Failure> failure = {};

  /// Adds another report; keeps the first failure.
  Report& operator+=(Report other) {
    heat += other.heat;
    external_power += other.external_power;
    external_work += other.external_work;
    lost += other.lost;
    outside += other.outside;
    demand += other.demand;
    if (!failure) failure = std::move(other.failure);
    return *this;
  }
};

/// Results of a chunk of rows.
struct ChunkReport {
  Real heat = 0;            ///< power turned into heat
  Real external_power = 0;  ///< power supplied by explicit dependence on time
  Real energy = 0;          ///< stored energy, if requested
  Index failed = nowhere;   ///< first row with a failure, or nowhere

  static constexpr Index nowhere = std::numeric_limits<Index>::max();
};
using ChunkReports = ChunkTally<ChunkReport>;

/// A result per particle that a term can compute for output.
struct FieldSource {
  std::string name;  ///< e.g. "pressure"
  int components;    ///< 1 or 9 (row-major tensor)
  Dimension dimension;
  std::string meaning;
  /// Fills `components` numbers for each particle of the term's body.
  std::function<void(const Motion&, std::span<Real>)> compute;
};

/// A scalar result that a term can compute for the history.
struct MeasureSource {
  std::string name;  ///< e.g. "area"
  Dimension dimension;
  std::string meaning;
  std::function<Real(const Motion&)> compute;
};

/// An effect. Only name() and add_force() are required; src/README.md lists what the other
/// functions are for, and what happens without them.
class ForceTerm {
 public:
  virtual ~ForceTerm() = default;

  /// Name in messages, timings and the audit: "internal force of 'drop'".
  virtual std::string name() const = 0;

  /// force[A] += the force of the term on each particle A. The result has the same bits for any
  /// number of threads and processes. `motion` may also be a trial motion, so this does not change
  /// the history of the term. A force that depends on sums over all rows is computed in phases
  /// (Forces::gather).
  virtual Report add_force(const Motion& motion, Forces force) = 0;
  /// force[A] += derivative of the forces in the direction `change` (du, dv and changes of fields;
  /// its time is ignored). The result is linear in `change`, whose size should be about one
  /// spacing: terms without an exact tangent use the difference of the forces over a millionth of
  /// `change`.
  virtual void add_tangent(const Motion& motion, const Motion& change, Forces force);

  /// Registers the particles whose motion the rows of this process read in add_force(),
  /// load_power() and commit(). Returns false if the term may read any particle: then each process
  /// follows the motion of all particles.
  virtual bool reads(StepReads&) { return false; }
  /// True if the particles registered by reads() are out of date because neighbours have changed.
  virtual bool reads_changed() const { return false; }

  /// Called when the step to `motion` is accepted. A term with a history updates it.
  virtual void commit(const Motion&) {}
  /// Saves or restores the history of the term. Does nothing if there is none.
  virtual void archive(const Archive&) {}

  /// True if the force depends on the velocity. It must then be linear in the velocity.
  virtual bool viscous() const { return false; }
  /// The next three functions are for steps that solve for the velocity. The part of the force that
  /// is linear in the velocity is - C v, where C is symmetric and positive semidefinite.
  ///
  /// Announces that add_viscous() will be called after calls of add_force().
  virtual void expect_viscous_calls() {}
  /// force[A] += - C v at the displacement of the last add_force(). Called for viscous terms only.
  /// The default is a difference of two forces, which allocates memory.
  virtual void add_viscous(const Motion& motion, Forces force);
  /// diagonal[A] += the diagonal entries of C for the components of particle A, at the displacement
  /// of the last add_force(). Missing entries only cost iterations.
  virtual void add_viscous_diagonal(Forces) {}

  /// Stored energy. energy_kind() is the column of the audit to which it belongs ("strain",
  /// "surface"). Empty if the force has no potential.
  virtual std::optional<Real> stored_energy(const Motion&) const { return std::nullopt; }
  virtual std::string_view energy_kind() const { return ""; }
  /// The function whose negative gradient is the force at zero velocity; equilibria are its
  /// stationary points. By default the stored energy. For a load it is the potential of the load,
  /// which the audit books as work. Empty if there is no such function.
  virtual std::optional<Real> potential(const Motion& motion) { return stored_energy(motion); }

  /// Power f.v of a load from outside. It is separate from the report, since forces are computed
  /// with the velocity of the half step, but the books use the velocity of the whole step.
  virtual Real load_power(const Motion&) { return 0; }

  /// External work, by explicit dependence on time, between two nearby equilibria, to second order.
  /// The default is the change of the energy when only the time changes, averaged over both
  /// motions.
  virtual Real work_between(const Motion& before, const Motion& after) const;

  /// The time after which the force depends on time through the motion only, such as the end of the
  /// last ramp. Infinite for a load that changes forever.
  virtual Real steady_after() const { return 0; }
  /// True if the term can stop bodies that drift.
  virtual bool stops_drift() const { return false; }
  /// Sum over the particles of the size of the forces before they cancel, e.g. the integral of |P|
  /// / spacing for an internal force. It is the scale of residuals and is computed rarely.
  virtual Real uncancelled_force(const Motion&) const { return 0; }

  /// True if the term may report a failure with `of_step`. The state before a step must then be
  /// kept.
  virtual bool may_reject_steps() const { return false; }

  /// A warning of a doubtful but possible state, as one sentence; looked for at output times.
  virtual std::optional<std::string> warning(const Motion&) const { return std::nullopt; }

  virtual std::vector<FieldSource> fields() const { return {}; }
  virtual std::vector<MeasureSource> measures() const { return {}; }

  /// Describes the failure of a row. Empty if this process does not have the row.
  virtual std::optional<Failure> failure_of(Index, const Motion&) const { return std::nullopt; }

  /// Bytes of memory that the term uses during the time loop.
  virtual std::size_t bytes() const { return 0; }
  /// Number of pairs (evaluation point or cell, particle) that one add_force() visits.
  virtual Offset pairs() const { return 0; }

 protected:
  /// Gathers the results of all chunks and sums them.
  Report report_of(ChunkReports& of_chunks, const Motion& motion, Forces force) const;
  /// Sums the results of all chunks, once they are gathered.
  Report sum_of(const ChunkReports& of_chunks, const Motion& motion, Forces force) const;
};

}  // namespace meniscus
