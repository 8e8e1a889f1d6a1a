// SPDX-License-Identifier: BSD-3-Clause
// The step that resolves the exchange of energy.
#pragma once
#include "solve/system.hpp"

namespace meniscus {

/// A stable step need not be an accurate one. Central differences keep, for constant step and
/// linear forces, not the energy H but H - dt^2/8 S, S = sum f^2/m (performance note 4): the
/// balance of energy is off by the changes of dt^2/8 S. Steps with dt^2/8 S <= eta E, E the most
/// energy that has been in motion so far, keep that error small against what is exchanged. What S
/// can come to be is known before: exchange leaves S + v.Kv as it is. In smooth motion the stable
/// step is far below; after a sudden release or an impact it is not.
template <int D>
class EnergyResolution {
 public:
  /// At a state that has its forces. Nothing at the start, when the change of forces is not known
  /// yet, and it grows from nothing where a body is let go from rest: the caller needs a least
  /// step.
  Real longest_step(const System<D>& system, const State& state);
  /// Throws StepError `of_step` if the step of dt to `state` disturbed the balance by considerably
  /// more than it may: forces have come that nothing announced.
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

  Sums judged_;             ///< of the step judged last
  Real S_ = 0, power_ = 0;  ///< sum f^2/m and sum f.v of the step before
  Real time_ = -1;          ///< of the step before; negative: there is none
  Real energy_ = 0;         ///< most that has been in motion: kinetic, dissipated and external work
  Real held_ = unbounded;   ///< the step in use
  Real least_ = unbounded;  ///< that was allowed in this window of steps
  std::int64_t window_end_ = 0;
};

}  // namespace meniscus
