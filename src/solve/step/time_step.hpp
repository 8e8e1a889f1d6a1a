// SPDX-License-Identifier: BSD-3-Clause
// The largest stable step of central differences, found from the discretised operator itself.
#pragma once
#include "meniscus/error.hpp"
#include "solve/step/critical_mode.hpp"
#include "solve/system.hpp"

namespace meniscus {

/// The stability limit. Let K be the stiffness, C the viscous matrix and M the lumped masses.
/// Central differences with a lagged viscous force are stable if dt^2/4 K + dt/2 C < M. For the
/// mode w that violates this first, k = w.Kw / w.Mw and c = w.Cw / w.Mw give dt = 4 / (c + sqrt(c^2
/// + 4 k)).
struct StableStep {
  Real dt = 0;          ///< the limit
  Real stiffness = 0;   ///< omega = sqrt(k) of the critical mode, 1/time
  Real viscosity = 0;   ///< c of the critical mode, 1/time
  int evaluations = 0;  ///< number of force evaluations
  bool steady = false;  ///< the response has hardly changed since this limit was found
  Real of_fields = std::numeric_limits<Real>::max();  ///< limit of the other unknown fields

  void archive(const Archive& a);
};

/// Finds the critical mode of the motion by conjugate gradients, and the critical modes of other
/// unknowns by power iteration, on differences of the force. The search starts with the mode found
/// before, so that a slowly changing body needs few evaluations. A change is detected by the
/// response to a rough displacement and velocity, which takes one evaluation.
///
/// Forces that jump, e.g. when a contact point passes the edge between two facets, look very stiff
/// for small trial displacements, but do not make steps unstable. If a term may have such jumps and
/// the step comes out short, the search is repeated with larger trial displacements.
template <int D>
class StableStepEstimator {
 public:
  /// `viscous`: the viscous force, at the velocity of the half step, limits the step. Otherwise the
  /// velocity is taken as zero.
  explicit StableStepEstimator(System<D>& system, bool viscous = true);

  /// Registers the vectors that are kept between estimates.
  void list_reads(StepReads& reads);

  /// Throws SolveError if no finite limit can be found.
  StableStep estimate(const State& state);
  /// An estimate for a state between steps, which has its forces. `before` is the last estimate; it
  /// is returned again if the response of all particles is unchanged.
  StableStep estimate_again(const State& state, const StableStep& before);
  /// A StepError with `cause`, at the particle that moves most in the last critical mode.
  StepError failure(std::string cause, const State& state) const;

  /// Saves or restores the last modes, with which later estimates start.
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
  bool may_jump_;    ///< forces of a term may jump
  Real spacing_;     ///< smallest particle distance
  Real trial_size_;  ///< size of trial displacements / spacing
  CriticalMode critical_;
  NodalVectors mode_, start_;
  NodalScratch u_, v_, base_, trial_force_;
  Real mode_limit_ = 0;  ///< limit by the rates of mode_ when it was found; 0: not yet found
  // Response (dt^2/4 K + dt/2 C) p to a rough p, for comparison with M p. known_response_ is the
  // response at the last search of the mode. response_ is the response at the last
  // estimate_again(), or before the search if the mode was searched again.
  NodalVectors known_response_;
  NodalScratch response_;
  Real response_step_ = 0;  ///< dt; 0: no response is known
  // For the other unknown fields.
  std::vector<NodalVectors> field_modes_, base_fields_;
  std::vector<Unknown> trial_;
};

}  // namespace meniscus
