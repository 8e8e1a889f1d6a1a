// SPDX-License-Identifier: BSD-3-Clause
// Dynamic relaxation of thin elastic bodies with an artificial inertia, which allows long steps.
#pragma once
#include "solve/step/elastic_inertia.hpp"
#include "solve/step/relaxation.hpp"

namespace meniscus {

/// Relaxation with the inertia M of ElasticInertia. Bodies start at rest. The kinetic energy of
/// this inertia beyond the energy of the real masses counts as dissipated.
template <int D>
class PseudoTime final : public Relaxation<D> {
 public:
  static constexpr int least_steps = 8;

  /// Steps are `safety` times the longest stable step.
  PseudoTime(System<D>& system, const typename Relaxation<D>::Tolerances& tolerances, Real safety);

  void begin(const State& state) override;
  bool chooses_step() const override { return true; }
  Real longest_step(const State& state) override { return step_.at_state(inertia_, state); }
  /// M^-1 reads the forces on all particles.
  bool reads(StepReads&) override { return false; }
  std::string effort() const override;
  void archive(const Archive& a, const State& state) override;

 private:
  using typename Relaxation<D>::ModeSums;
  using Relaxation<D>::system_;
  using Relaxation<D>::last_u_;
  using Relaxation<D>::last_force_;
  using Relaxation<D>::du_;
  using Relaxation<D>::df_;

  void move(State& state, Real dt) override;
  Real energy_of_motion(const State& state) const override;
  ModeSums sums_of_step(const State& state) const override;
  ModeSums sums_of_interval(const State& state) const override;
  void follow_brake(State& state, Real factor, Real omega_dt) override;
  Real fewest_steps() const override { return least_steps; }
  void begin_interval() override;
  /// Computes acceleration_ and beyond_ from a state and momentum_.
  void take_up(const State& state);

  ElasticInertia<D> inertia_;
  ElasticStep<D> step_;
  NodalVectors momentum_, acceleration_;     ///< M v, M^-1 f
  NodalVectors impulse_, interval_impulse_;  ///< M du of the last step, and of the interval
  Real beyond_ = 0;                          ///< kinetic energy minus that of the real masses
  bool starts_ = true;                       ///< the next step is the first one and starts at rest
};

}  // namespace meniscus
