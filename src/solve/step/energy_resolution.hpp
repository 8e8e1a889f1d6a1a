// SPDX-License-Identifier: BSD-3-Clause
// The longest step that resolves the exchange of energy.
#pragma once
#include "solve/system.hpp"

namespace meniscus {

/// Limits the step by accuracy; a stable step need not be accurate. For a constant step and linear
/// forces, central differences conserve H - dt^2/8 S instead of the energy H, with S = sum f^2/m
/// (performance note 4). The error of the energy balance is thus the change of dt^2/8 S. It stays
/// small against the exchanged energy if dt^2/8 S <= eta E, where E is the largest energy in motion
/// so far. The largest future S is known in advance, since an exchange of energy keeps S + v.Kv. In
/// smooth motion the stable step is far below this limit; after a sudden release or an impact it is
/// not.
template <int D>
class EnergyResolution {
 public:
  /// The longest accurate step at a state that has its forces. It is 0 at the start, when the
  /// change of forces is unknown, and grows from 0 if a body is released from rest. The caller
  /// therefore needs a smallest step.
  Real longest_step(const System<D>& system, const State& state);
  /// Throws StepError `of_step` if the step of dt to `state` disturbed the balance by considerably
  /// more than allowed, because forces rose unexpectedly.
  void judge(const System<D>& system, const State& state, Real dt);

  void archive(const Archive& a);

 private:
  /// Kinetic energy, S, and the power sum f.v, at a time.
  struct Sums {
    Real kinetic = 0, S = 0, power = 0, time = -1;
  };
  static Sums sums(const System<D>& system, const State& state);
  void remember(Real S, Real power, Real time);
  Real exchanged(Real S, Real power, Real time) const;
  void hold(Real allowed, std::int64_t step);

  Sums judged_;             ///< of the last step that was judged
  Real S_ = 0, power_ = 0;  ///< sum f^2/m and sum f.v of the step before
  Real time_ = -1;          ///< of the step before; negative: there is none
  Real energy_ = 0;         ///< largest so far: kinetic + dissipated + |external work|
  Real held_ = unbounded;   ///< step in use
  Real least_ = unbounded;  ///< smallest limit in this interval of steps
  std::int64_t interval_end_ = 0;
};

}  // namespace meniscus
