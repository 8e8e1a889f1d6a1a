// SPDX-License-Identifier: BSD-3-Clause
// Constraints of a system: C u = g(t), and the forces C^T lambda that keep it.
#pragma once
#include "parallel/aligned.hpp"
#include "physics/constraint.hpp"
#include "solve/linear/sparse_factors.hpp"
#include "solve/state.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// (held-faces note 2) All constraints together, with the sparse factors of S = C M^-1 C^T, M the
/// lumped masses. In central differences they are met at every whole step, to round-off:
///   u_n+1 and v_n+1/2 are moved by dt^2 M^-1 C^T d and dt M^-1 C^T d, so that C u_n+1 = g_n+1;
///   lambda_n+1 is what makes C a_n+1 = g''_n+1 the acceleration of the kick that follows.
/// The forces of a state contain its reactions C^T lambda. Their work is counted without error:
/// what they change the kinetic energy by in both half kicks of a step.
class Constraints {
 public:
  /// Throws InputError where particles cannot follow: a row depends on the others.
  Constraints(std::vector<std::unique_ptr<Constraint>> all, std::span<const Real> mass);

  Index rows() const { return static_cast<Index>(row_.size()); }
  /// Those that rows touch, in ascending order: of no other is anything read or changed.
  std::span<const Index> particles() const { return touched_; }
  const std::vector<std::unique_ptr<Constraint>>& all() const { return all_; }
  /// From when on g is constant.
  Real steady_after() const;

  /// g(t)
  void targets(Real time, std::vector<Real>& g) const;
  /// C w
  void apply(std::span<const NodalVector> w, std::vector<Real>& Cw) const;
  /// C M^-1 f
  void apply_over_mass(std::span<const NodalVector> f, std::vector<Real>& CMf) const;
  /// f += factor C^T lambda
  void add_transposed(const std::vector<Real>& lambda, Real factor, std::span<NodalVector> f) const;
  /// w += factor M^-1 C^T lambda
  void add_over_mass(const std::vector<Real>& lambda, Real factor, std::span<NodalVector> w) const;
  /// b becomes S^-1 b.
  void solve(std::vector<Real>& b) const;
  /// w -= M^-1 C^T S^-1 C w: what is left is free, C w = 0.
  void project(std::span<NodalVector> w);

  /// At rest: adds to the force C^T lambda, the reactions that leave no C M^-1 f.
  void balance(std::span<NodalVector> force, std::vector<Real>& lambda) const;

  /// Moves places and velocities to where they are prescribed at state.time: the nearest in the
  /// norm of the masses.
  void make_consistent(State& state);
  /// Adds the reactions to the forces of a state that begins.
  void begin(State& state);
  /// After a drift to state.time with the velocity of the half step; state.force is still that
  /// from before.
  void constrain(State& state, Real dt);
  /// Adds the reactions to the forces at the end of the step, before the last half kick.
  void react(State& state, Real dt);

  /// Moves velocities at the end of a step to those of a last half kick that begins at `half` with
  /// what react() makes of its force: C v = C half + dt/2 g''(time), the nearest in the norm of the
  /// masses.
  void prescribe(std::span<const NodalVector> half, Real time, Real dt, std::span<NodalVector> v);
  /// Whether any of these particles is held.
  bool hold_any(Index first, Index count) const;

  /// After react(), velocities were changed at state.time: back to the prescribed ones.
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
  /// C, applied to f / m if `over_mass`.
  template <bool over_mass>
  void gather(std::span<const NodalVector> w, std::vector<Real>& Cw) const;
  template <bool over_mass>
  void scatter(const std::vector<Real>& lambda, Real factor, std::span<NodalVector> w) const;
  /// Of impulses at the places x in at_place_: work, momentum and angular momentum.
  void book(State& state, const std::vector<Real>& impulse, const std::vector<Real>& before,
            const std::vector<Real>& after) const;
  /// Fills at_place_ with the mean places of u - back v.
  void find_places(const State& state, Real back) const;
  /// g' and g'' at a time: by differences over h, forward ones at the beginning.
  void rates(Real time, Real h, bool begins);

  std::vector<std::unique_ptr<Constraint>> all_;
  std::vector<Real> mass_;
  std::vector<Row> row_;
  /// Rows that share the factors of S: those of a place, if all places have rows along the same
  /// directions, at right angles to each other; otherwise 1.
  Index alike_ = 1;
  std::vector<Offset> start_{0};  // of the places of all
  std::vector<Index> particle_;
  std::vector<Real> weight_;
  NodalVectors X_;  // [place] mean reference place
  // By particle: its places and weights.
  std::vector<Index> touched_;
  std::vector<Offset> touched_start_{0};
  std::vector<Index> touched_place_;
  std::vector<Real> touched_weight_;
  SparseCholesky factors_;
  // Scratch.
  mutable NodalVectors at_place_;
  std::vector<Real> a_, b_, before_, after_, g_, rate_, acceleration_, ahead_, behind_;
};

}  // namespace meniscus
