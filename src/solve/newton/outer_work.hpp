// SPDX-License-Identifier: BSD-3-Clause
// Work from outside between states at rest.
#pragma once
#include "solve/system.hpp"

#include <vector>

namespace meniscus {

/// (quasi-statics note 2) Takes a state from equilibrium to equilibrium and books what held faces
/// and all else from outside do on the way: by the mean of the forces before and after, which two
/// pieces of the way together correct to third order in their length.
template <int D>
class OuterWork {
 public:
  explicit OuterWork(System<D>& system);

  /// In a piece of the way.
  struct Exchange {
    Real work = 0, stored = 0;
    Real released() const { return work - stored; }
    Real size() const { return std::abs(work) + std::abs(stored); }
  };
  struct Piece {
    Real dt = 0;  ///< 0: nothing is known of it
    NodalVectors du;
    std::vector<Real> work;    ///< of each held face and, last, of all else from outside
    std::vector<Real> lambda;  ///< of the constraints, at its beginning
  };

  /// Moves the state to u at `time`, with its forces and reactions, and books the work.
  Exchange move(State& state, Real time, const NodalVectors& u);
  /// After a move to `state`, for both this piece and the last: what the means of the forces leave
  /// After a move from `before` to `state`, what the means of the forces over this piece and the
  /// last leave out.
  void book_bend(const State& before, State& state);
  /// The piece moved becomes the last; after a jump nothing can be told from it.
  void go_on(bool jump);
  void forget() { last_.dt = 0; }
  const Piece& last() const { return last_; }

  void archive(const Archive& a);

 private:
  /// Where work is counted from, or to.
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

/// Of all terms.
template <int D>
Real stored_energy(const System<D>& system, const Motion& motion);

}  // namespace meniscus
