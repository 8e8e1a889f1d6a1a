// SPDX-License-Identifier: BSD-3-Clause
// External work between states at rest.
#pragma once
#include "solve/system.hpp"

#include <vector>

namespace meniscus {

/// Moves a state from equilibrium to equilibrium and books the work of held faces and loads on the
/// way (quasi-statics note 2). The work uses the mean of the forces before and after. Two
/// consecutive pieces of the way together correct it to third order in their length.
template <int D>
class OuterWork {
 public:
  explicit OuterWork(System<D>& system);

  /// Energies of one piece of the way.
  struct Exchange {
    Real work = 0, stored = 0, lost = 0;  ///< lost: Report::lost
    Real released() const { return work - stored - lost; }
    Real size() const { return std::abs(work) + std::abs(stored) + lost; }
  };
  struct Piece {
    Real dt = 0;  ///< 0: unknown
    NodalVectors du;
    std::vector<Real> work;    ///< by each held face and, as last entry, by all loads
    std::vector<Real> lambda;  ///< of the constraints, at the begin of the piece
  };

  /// Moves the state to u at `time`, computes forces and reactions, and books the work.
  Exchange move(State& state, Real time, const NodalVectors& u);
  /// Call this after a move from `before` to `state`. Books the error of the mean forces over this
  /// piece and the last piece, as estimated from both pieces together.
  void book_bend(const State& before, State& state);
  /// Makes the piece just moved the last piece. After a jump, the last piece is forgotten.
  void go_on(bool jump);
  void forget() { last_.dt = 0; }
  const Piece& last() const { return last_; }

  void archive(const Archive& a);

 private:
  /// The begin or the end of a way along which work is computed.
  struct End {
    Real time;
    const NodalVectors& u;
    const std::vector<Real>& lambda;
  };
  std::vector<Real> work_between(const End& before, const End& after);

  System<D>& system_;
  Piece moved_, last_;
  NodalVectors way_;
  std::vector<Real> way_of_rows_;
};

/// Sum of the stored energies of all terms.
template <int D>
Real stored_energy(const System<D>& system, const Motion& motion);

}  // namespace meniscus
