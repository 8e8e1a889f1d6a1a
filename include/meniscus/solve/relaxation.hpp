// SPDX-License-Identifier: BSD-3-Clause
// The way to equilibrium: explicit dynamics that is led downhill, until nothing moves.
#pragma once
#include "meniscus/core/snapshot.hpp"
#include "meniscus/solve/system.hpp"

namespace meniscus {

/// Fast inertial relaxation (FIRE; Bitzek et al. 2006) on top of the steps of central differences:
/// as long as the forces do work, the velocity turns into their direction; when they no longer do,
/// the motion stops and begins anew. Forces are those of dynamics, and so is the stable step. Loads
/// with ramps run over the same time.
///
/// After the last ramp the bodies are observed over quarter periods of the slowest mode that moves:
/// they are at rest when both measures below are small at the end of two in a row. Neither momentum
/// nor angular momentum comes into bodies that have none, so that they do not drift.
template <int D>
class Relaxation {
 public:
  struct Tolerances {
    /// Of sum |f_A| over the particles, relative to the forces before they cancel
    /// (ForceTerm::uncancelled_force).
    Real force;
    /// Of the largest change of place within a quarter period, relative to the extent of its body.
    Real shape;
  };

  Relaxation(System<D>& system, const Tolerances& tolerances);

  /// Begins to observe at `state`, which has its forces.
  void begin(const State& state);

  /// To be called after every step: leads the velocities, books what that takes from the kinetic
  /// energy as dissipated, and judges the state at the end of a quarter period.
  void lead(State& state, Real dt);

  bool at_rest() const { return settled_periods_ >= 2; }
  /// Of the present state.
  Real force_residual(const State& state) const;
  /// Over the last quarter period; 1 before there was one.
  Real shape_change() const { return shape_change_; }
  /// When the last ramp of the system ends.
  Real steady_after() const;

  void save(Snapshot& snapshot) const;
  /// Begins at `state` if the snapshot is not of a relaxation.
  void restore(const Snapshot& snapshot, const State& state);

 private:
  void stop(State& state);
  void turn(State& state, Real work);
  void open_period(const State& state, Real length);
  void judge(const State& state, Real dt);
  /// sqrt(- du.df / du.M du) of the changes since the beginning of the period; 0 if there is none.
  Real frequency(const State& state) const;
  Real largest_change(const State& state) const;

  System<D>& system_;
  Tolerances tolerances_;
  Real mixing_ = 0;                       ///< alpha of FIRE
  std::int64_t downhill_steps_ = 0;       ///< since the last stop
  NodalVectors period_u_, period_force_;  ///< at the beginning of the quarter period
  Real period_begin_ = 0, period_length_ = 0;
  Real shape_change_ = 1;
  std::int64_t settled_periods_ = 0;
};

}  // namespace meniscus
