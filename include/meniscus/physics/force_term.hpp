// SPDX-License-Identifier: BSD-3-Clause
// The one interface of all physical effects. A scene's system is a list of terms; an effect that
// the scene does not name is not in the list and costs nothing.
#pragma once
#include "parallel/chunk_reports.hpp"
#include "parallel/step_reads.hpp"
#include "physics/constraint.hpp"
#include "physics/resultant.hpp"
#include "physics/unknown.hpp"
#include "state/archive.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

class ForceTerm;

/// What forces depend on. Displacement and velocity coefficients of the particles of all bodies.
struct Motion {
  Real time;
  std::span<const NodalVector> u, v;
  std::span<const Unknown> fields = {};  ///< by the numbers of System::add_field
  const Reactions* reactions = nullptr;  ///< of the constraints; for measures only
};

/// What ForceTerm::stored_energy() of a term would say.
struct StoredEnergy {
  const ForceTerm* term;
  Real value;
};

/// Forces on the coefficients of the displacement of all particles, and the fields that have forces
/// of their own, Unknown::f.
struct Forces : std::span<NodalVector> {
  Forces(std::span<NodalVector> f, std::span<Unknown> unknowns = {})
      : std::span<NodalVector>(f), fields(unknowns) {}
  Forces(NodalVectors& f) : std::span<NodalVector>(f) {}

  std::span<Unknown> fields;
  /// Where terms that have it at hand put their stored energy; none: it is not asked for.
  std::vector<StoredEnergy>* energies = nullptr;
  /// Whether terms leave what they say per chunk of rows to Report::chunks.
  bool leave_chunks = false;
};

/// Why a term could not compute a force that makes sense.
struct Failure {
  Index particle;         ///< global number of the particle nearest to the failure
  std::string cause;      ///< e.g. "J = -0.3 at a stress point; F = [...]"
  bool of_step = false;   ///< a shorter step may avoid it
  std::string term = {};  ///< name of the term; the system fills it in
};

/// What the next step has to respect before the stable step is estimated again. Only terms whose
/// stiffness grows by multiples within few steps have a demand.
struct StepDemand {
  Real stiffness = 0;  ///< squared frequencies that the term adds at most within the step, 1/time^2
  Real longest = std::numeric_limits<Real>::max();  ///< longest step

  StepDemand& operator+=(const StepDemand& other) {
    stiffness += other.stiffness;
    longest = std::min(longest, other.longest);
    return *this;
  }
};

/// What a force call says besides the forces, about the motion it was called with.
struct Report {
  Real heat = 0;  ///< power turned into heat
  /// Power supplied from outside by what changes with time at fixed places:
  /// ramps, partners that are moved. What a load does on the velocity is load_power().
  Real external_power = 0;
  /// Work supplied since the last step that stands, of what may jump in time.
  Real external_work = 0;
  /// Net force and moment of what acts from outside. A term whose forces are to balance each other
  /// leaves it zero, so that the audit sees where they do not.
  Resultant outside = {};
  StepDemand demand = {};
  std::optional<Failure> failure = {};
  /// What is left to be brought to all ranks and added by ForceTerm::add_chunks().
  ChunkReports* chunks = nullptr;
  /// The rank that alone knows the above, which is left to be brought to all; none: all do.
  std::optional<int> known_by = {};
  /// What it would have thrown as SolveError, where others do not know it; it is thrown by all
  /// then.
  std::string error = {};

  /// Sums; the first failure stays.
  Report& operator+=(Report other) {
    heat += other.heat;
    external_power += other.external_power;
    external_work += other.external_work;
    outside += other.outside;
    demand += other.demand;
    if (!failure) failure = std::move(other.failure);
    return *this;
  }
};

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

class ForceTerm {
 public:
  virtual ~ForceTerm() = default;

  /// Name in messages, timings and the audit: "internal force of 'drop'".
  virtual std::string name() const = 0;

  /// force[A] += ... over all particles. Same bits for any thread count. Called for any motion,
  /// also trial ones: the history of the term stays as it is.
  virtual Report add_force(const Motion& motion, Forces force) = 0;
  /// Adds to its report what all ranks have said in Report::chunks, which they know by now. All
  /// ranks call this.
  void add_chunks(const Motion& motion, Forces force, Report& report) const;
  /// force[A] += the derivative of the forces for a change of the motion by `change` (du, dv and
  /// field changes; its time counts for nothing). Linear in `change`, which should be of the size
  /// of a spacing: without an exact tangent it is the difference of the forces over a millionth of
  /// it.
  virtual void add_tangent(const Motion& motion, const Motion& change, Forces force);

  /// Of a run of several ranks: says of which particles this rank reads the motion in add_force(),
  /// load_power() and commit(). While the halo that follows from it is entered, these are asked for
  /// the forces on the particles that it follows, and know the motion of no other. False: it may be
  /// that of all, whatever was said. All ranks call this.
  virtual bool tell_reads(StepReads&) { return false; }
  /// Whether it would say something else by now: what is near to what has changed.
  virtual bool reads_changed() const { return false; }
  /// Whether a term may come to need more than it said in the middle of a step, where it throws
  /// HaloOutgrown on all ranks.
  virtual bool may_outgrow_halo() const { return false; }

  /// The step to `motion` stands: a term with history makes this its past.
  virtual void commit(const Motion&) {}
  /// Keeps the history; without one, nothing.
  virtual void archive(const Archive&) {}
  /// After steps in a halo: brings all ranks the history that some of them have kept for all. All
  /// ranks call this.
  virtual void complete_history() {}

  /// Whether the force depends on the velocity, of which it is then a linear function.
  virtual bool viscous() const { return false; }
  /// For steps that solve for the velocity. What is linear in it is - C v with C symmetric and not
  /// negative.
  ///
  /// Says that add_viscous() is going to be called after calls of add_force().
  virtual void expect_viscous_calls() {}
  /// force[A] += - C v, at the displacement of the last add_force(); asked of viscous terms only.
  /// Without a function of its own the difference of two forces, which takes memory.
  virtual void add_viscous(const Motion& motion, Forces force);
  /// diagonal[A] += the entries of C for the components of particle A, at the displacement of the
  /// last add_force(). What a term leaves out costs iterations.
  virtual void add_viscous_diagonal(std::span<NodalVector>) {}

  /// Stored energy and the column of the audit it belongs to ("strain", "surface"); none if the
  /// force has no potential.
  virtual std::optional<Real> stored_energy(const Motion&) const { return std::nullopt; }
  virtual std::string_view energy_kind() const { return ""; }
  /// What equilibria without motion make stationary: the force at zero velocity is minus its
  /// gradient. That is the stored energy, or the potential of a load that the audit books as work;
  /// none if there is no such function.
  virtual std::optional<Real> potential(const Motion& motion) { return stored_energy(motion); }

  /// Power f.v of a load from outside on the velocity of the motion. Apart from the report: forces
  /// are computed with the velocity of the half step, the books kept with that of the whole step.
  virtual Real load_power(const Motion&) { return 0; }

  /// Work from outside, of what changes with time at fixed places, on the way from one equilibrium
  /// to another nearby, to second order: here the mean of what the change of time does to the
  /// energy at both.
  virtual Real work_between(const Motion& before, const Motion& after) const;

  /// From when on the force depends on time through the motion only: the end of the last ramp;
  /// infinite for a load that never ceases to change.
  virtual Real steady_after() const { return 0; }
  /// Whether bodies may drift to where the term stops them.
  virtual bool stops_drift() const { return false; }
  /// Sum over the particles of the size of the forces on each before they cancel, to measure a
  /// residual by: integral of |P| / spacing for an internal force. Asked now and then only.
  virtual Real uncancelled_force(const Motion&) const { return 0; }

  /// Whether a failure may be one `of_step`, so that the state before a step has to be kept.
  virtual bool may_reject_steps() const { return false; }

  /// Doubtful but possible states, looked for at output times; one sentence.
  virtual std::optional<std::string> warning(const Motion&) const { return std::nullopt; }

  virtual std::vector<FieldSource> fields() const { return {}; }
  virtual std::vector<MeasureSource> measures() const { return {}; }

  /// Puts the failure of a row into words. All ranks call this.
  virtual std::optional<Failure> failure_of(Index, const Motion&) const { return std::nullopt; }

  /// Bytes held for the time loop.
  virtual std::size_t bytes() const = 0;
  /// Pairs (evaluation point or cell, particle) visited by one add_force().
  virtual Offset pairs() const = 0;

 protected:
  /// The report of a term whose chunks of rows have said all.
  Report report_of(ChunkReports& said, const Motion& motion, Forces force) const;
};

}  // namespace meniscus
