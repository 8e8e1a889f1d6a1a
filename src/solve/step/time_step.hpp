// SPDX-License-Identifier: BSD-3-Clause
// The largest stable step of central differences, from the discretised operator itself.
#pragma once
#include "meniscus/error.hpp"
#include "solve/step/critical_mode.hpp"
#include "solve/system.hpp"

namespace meniscus {

/// With K the stiffness, C the viscous matrix and M the lumped masses, central differences with a
/// lagged viscous force are stable if dt^2/4 K + dt/2 C < M. For the mode w that is the first to
/// break this, k = w.Kw / w.Mw and c = w.Cw / w.Mw give dt = 4 / (c + sqrt(c^2 + 4 k)).
struct StableStep {
  Real dt = 0;          ///< the limit
  Real stiffness = 0;   ///< omega = sqrt(k) of the critical mode, 1/time
  Real viscosity = 0;   ///< c of the critical mode, 1/time
  int evaluations = 0;  ///< force evaluations spent
  bool steady = false;  ///< no response has changed by a tenth of what shows since it was found
  Real of_fields = std::numeric_limits<Real>::max();  ///< the limit of the other unknown fields

  void archive(const Archive& a);
};

/// Finds the critical mode of the motion by conjugate gradients, and those of other unknowns by
/// power iteration, on differences of the force, starting with the mode found before: a new
/// estimate of a slowly changing body takes a few evaluations. Whether it changes is seen from the
/// response to a rough displacement and velocity, which takes one. Forces that jump, as that of a
/// contact point above the edge of two facets, are as stiff as the change of places is small, but
/// do not make steps unstable: where a term may do so, a step that comes out short is looked for
/// with changes so large that the jump does not count. In a halo all of this is done on the
/// particles that each rank follows.
template <int D>
class StableStepEstimator {
 public:
  /// `viscous`: whether the viscous force, taken at the velocity of the half step before, counts;
  /// without it the velocity is taken for zero.
  explicit StableStepEstimator(System<D>& system, bool viscous = true);

  /// Whether it can be asked in a halo: contacts may need more.
  bool keeps_to_halo() const { return keeps_to_halo_; }
  /// Vectors that it keeps from estimate to estimate.
  void tell_reads(StepReads& reads);

  /// Throws SolveError if no finite limit can be found.
  StableStep estimate(const State& state);
  /// Of a state between steps, whose force is that of now, when `before` was found last: that again
  /// if no particle responds in another way.
  StableStep estimate_again(const State& state, const StableStep& before);
  /// `cause` at the particle that the critical mode found last moves most.
  StepError failure(std::string cause, const State& state) const;

  /// Keeps the modes found last, from which later estimates start.
  void archive(const Archive& a);

 private:
  void find_base_forces(const State& state);
  StableStep limit_from_base(const State& state, Real doubtful);
  StableStep limit_without_jumps(const State& state, Real doubtful);
  StableStep limit_of_motion(const State& state);
  bool is_smooth(const State& state, StableStep& found);
  void find_response(const State& state, std::span<NodalVector> response);
  void know_response(const State& state, Real dt);
  bool responds_as_before(Real tolerated) const;
  void start_where_it_changed();
  void find_stiff_forces(const State& state, Real size, TrialMode& trial);
  void find_viscous_forces(const State& state, Real rate, TrialMode& trial);
  void force_change(const State& state, std::span<const NodalVector> w, Real du, Real dv, Real size,
                    std::span<NodalVector> result);
  Real largest(std::span<const NodalVector> w) const;
  void carry_trial(const State& state);
  Real field_limit(const State& state, std::size_t number);
  Real field_limit(const State& state, std::size_t number,
                   const std::function<void(Unknown&)>& forces);
  void set_stages(const State& state, std::size_t number);

  System<D>& system_;
  bool viscous_counts_;
  bool may_jump_;  ///< forces of some term
  bool keeps_to_halo_;
  Real spacing_;     ///< smallest particle distance
  Real trial_size_;  ///< of the trial displacements, part of the spacing
  CriticalMode critical_;
  NodalVectors mode_, start_;
  NodalScratch u_, v_, base_, trial_force_;
  Real mode_limit_ = 0;  ///< by the quotient of mode_, when that was found; 0: not yet
  // (dt^2/4 K + dt/2 C) p of a rough p, to be compared with M p: when the mode was looked for last,
  // and after estimate_again() now or, where the mode was looked for, before.
  NodalVectors known_response_;
  NodalScratch response_;
  Real response_step_ = 0;  ///< dt; 0: no response is known
  // Of the unknown fields.
  std::vector<NodalVectors> field_modes_, base_fields_;
  std::vector<Unknown> trial_;
};

}  // namespace meniscus
