// SPDX-License-Identifier: BSD-3-Clause
// The largest stable step of central differences, from the discretised operator itself.
#pragma once
#include "meniscus/core/error.hpp"
#include "meniscus/solve/critical_mode.hpp"
#include "meniscus/solve/system.hpp"

namespace meniscus {

/// With K the stiffness, C the viscous matrix and M the lumped masses, central differences with a
/// lagged viscous force are stable if dt^2/4 K + dt/2 C < M. For the mode w that is the first to
/// break this, k = w.Kw / w.Mw and c = w.Cw / w.Mw give dt = 4 / (c + sqrt(c^2 + 4 k)): 2/omega
/// without viscosity, 2/c without stiffness.
struct StableStep {
  Real dt = 0;          ///< the limit
  Real stiffness = 0;   ///< omega = sqrt(k) of the critical mode, 1/time
  Real viscosity = 0;   ///< c of the critical mode, 1/time
  int evaluations = 0;  ///< force evaluations spent
  Real of_fields = std::numeric_limits<Real>::max();  ///< the limit of the other unknown fields

  void archive(const Archive& a);
};

/// Finds the critical mode of the motion by conjugate gradients, and those of other unknowns by
/// power iteration, on differences of the force, starting with the mode found before: a new
/// estimate of a slowly changing body takes a few evaluations.
template <int D>
class StableStepEstimator {
 public:
  /// `viscous`: whether the viscous force, taken at the velocity of the half step before, counts;
  /// without it the velocity is taken for zero.
  explicit StableStepEstimator(System<D>& system, bool viscous = true);

  /// Throws SolveError if no finite limit can be found.
  StableStep estimate(const State& state);
  /// `cause` at the particle that the critical mode found last moves most.
  StepError failure(std::string cause, const State& state) const;

  /// Keeps the modes found last, from which later estimates start.
  void archive(const Archive& a);

 private:
  StableStep limit_of_motion(const State& state);
  void find_stiff_forces(const State& state, TrialMode& trial);
  void find_viscous_forces(const State& state, Real rate, TrialMode& trial);
  void force_change(const State& state, const NodalVectors& w, Real du, Real dv,
                    NodalVectors& result);
  void carry_trial(const State& state);
  Real field_limit(const State& state, std::size_t number);
  Real field_limit(const State& state, std::size_t number,
                   const std::function<void(Unknown&)>& forces);
  void set_stages(const State& state, std::size_t number);

  System<D>& system_;
  bool viscous_counts_;
  Real spacing_;  ///< smallest particle distance: scale of the trial displacements
  CriticalMode critical_;
  NodalVectors mode_, u_, v_, base_, trial_force_;
  // Of the unknown fields.
  std::vector<NodalVectors> field_modes_, base_fields_;
  std::vector<Unknown> trial_;
};

}  // namespace meniscus
