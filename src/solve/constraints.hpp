// SPDX-License-Identifier: BSD-3-Clause
// Constraints of a system: C u = g(t), and the reactions C^T lambda that enforce them.
#pragma once
#include "parallel/aligned.hpp"
#include "physics/constraint.hpp"
#include "solve/linear/sparse_factors.hpp"
#include "solve/state.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// All constraints of a system (held-faces note 2), with sparse factors of S = C M^-1 C^T, where M
/// are the lumped masses. Central differences satisfy them at every whole step to round-off:
///   u_n+1 and v_n+1/2 are corrected by dt^2 M^-1 C^T d and dt M^-1 C^T d, so that C u_n+1 = g_n+1;
///   lambda_n+1 gives C a_n+1 = g''_n+1 for the acceleration a_n+1 of the next kick.
/// The forces of a state contain its reactions C^T lambda. The work of the reactions is exact: it
/// is their change of the kinetic energy in both half kicks of a step.
class Constraints {
 public:
  /// Throws InputError if a row depends on other rows, so that the particles cannot satisfy all of
  /// them.
  Constraints(std::vector<std::unique_ptr<Constraint>> all, std::span<const Real> mass);

  Index rows() const { return static_cast<Index>(row_.size()); }
  /// The particles that appear in rows, in ascending order. No other particle is read or changed.
  std::span<const Index> particles() const { return touched_; }
  const std::vector<std::unique_ptr<Constraint>>& all() const { return all_; }
  /// The time after which g is constant.
  Real steady_after() const;

  /// g = g(t)
  void targets(Real time, std::vector<Real>& g) const;
  /// Cw = C w
  void apply(std::span<const NodalVector> w, std::vector<Real>& Cw) const;
  /// CMf = C M^-1 f
  void apply_over_mass(std::span<const NodalVector> f, std::vector<Real>& CMf) const;
  /// f += factor C^T lambda
  void add_transposed(const std::vector<Real>& lambda, Real factor, std::span<NodalVector> f) const;
  /// w += factor M^-1 C^T lambda
  void add_over_mass(const std::vector<Real>& lambda, Real factor, std::span<NodalVector> w) const;
  /// Replaces b by S^-1 b.
  void solve(std::vector<Real>& b) const;
  /// w -= M^-1 C^T S^-1 C w, so that C w = 0.
  void project(std::span<NodalVector> w);

  /// For equilibria: sets lambda and adds C^T lambda to the force, so that C M^-1 f = 0.
  void balance(std::span<NodalVector> force, std::vector<Real>& lambda) const;

  /// Moves displacements and velocities to their prescribed values at state.time. The change is the
  /// smallest in the norm of the masses.
  void make_consistent(State& state);
  /// Adds the reactions to the forces of the first state of a run.
  void begin(State& state);
  /// Corrects displacements and velocities after a drift to state.time with the velocity of the
  /// half step. state.force must still be the force before the drift.
  void constrain(State& state, Real dt);
  /// Adds the reactions to the forces at the end of the step, before the last half kick.
  void react(State& state, Real dt);

  /// Corrects the velocities v at the end of a step so that C v = C half + dt/2 g''(time). This
  /// holds for a last half kick that begins at `half` with a force corrected by react(). The change
  /// is the smallest in the norm of the masses.
  void prescribe(std::span<const NodalVector> half, Real time, Real dt, std::span<NodalVector> v);
  /// True if any of the particles first, ..., first + count - 1 is held.
  bool hold_any(Index first, Index count) const;

  /// Restores the prescribed velocities at state.time after velocities were changed. Call it after
  /// react().
  void restore_velocities(State& state);

  std::size_t bytes() const;

 private:
  struct Row {
    Index place;
    Lanes direction;
  };
  void list_rows();
  Index count_alike() const;
  SparseCholesky factors() const;
  void require_independent() const;
  /// Cw = C w, or C M^-1 w if `over_mass`.
  template <bool over_mass>
  void gather(std::span<const NodalVector> w, std::vector<Real>& Cw) const;
  template <bool over_mass>
  void scatter(const std::vector<Real>& lambda, Real factor, std::span<NodalVector> w) const;
  /// Books impulses at the positions x in at_place_: work, momentum and angular momentum.
  void book(State& state, const std::vector<Real>& impulse, const std::vector<Real>& before,
            const std::vector<Real>& after) const;
  /// Fills at_place_ with mean positions at the displacements u - back v.
  void find_places(const State& state, Real back) const;
  /// Sets rate_ = g' and acceleration_ = g'' at a time, by differences over h. The differences are
  /// one-sided (forward) if `begins`.
  void rates(Real time, Real h, bool begins);

  std::vector<std::unique_ptr<Constraint>> all_;
  std::vector<Real> mass_;
  std::vector<Row> row_;
  /// Number of rows that share the factors of S. It is the number of rows per place if all places
  /// have rows along the same orthogonal directions; otherwise 1.
  Index alike_ = 1;
  std::vector<Offset> start_{0};  // entries of the places of all constraints
  std::vector<Index> particle_;
  std::vector<Real> weight_;
  NodalVectors X_;  // [place] mean reference place
  // For each particle: its places and weights.
  std::vector<Index> touched_;
  std::vector<Offset> touched_start_{0};
  std::vector<Index> touched_place_;
  std::vector<Real> touched_weight_;
  SparseCholesky factors_;
  // Work space.
  mutable NodalVectors at_place_;
  std::vector<Real> a_, b_, before_, after_, g_, rate_, acceleration_, ahead_, behind_;
};

}  // namespace meniscus
