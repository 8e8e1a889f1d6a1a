// SPDX-License-Identifier: BSD-3-Clause
// The mode that becomes unstable first, found from the forces of trial displacements.
#pragma once
#include "parallel/followed_particles.hpp"

#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace meniscus {

/// A change w of the displacements or velocities, and the forces against it: K w, and C w if there
/// is viscosity.
struct TrialMode {
  NodalScratch w, Kw, Cw;
};

/// The rates k = w.Kw / w.Mw and c = w.Cw / w.Mw of a mode.
struct ModeRates {
  Real stiffness = 0, viscosity = 0;

  /// The longest stable step of central differences with a lagged viscous force: 2/omega without
  /// viscosity, 2/c without stiffness.
  Real longest_step() const {
    return 4 / (viscosity + std::sqrt(viscosity * viscosity + 4 * stiffness));
  }
};

/// Finds the largest eigenvalue of A = dt^2/4 K + dt/2 C relative to the masses, by conjugate
/// gradients for one mode (Knyazev, SIAM J. Sci. Comput. 23 (2001) 517). Each iteration takes the
/// best combination of three vectors: the present mode, the residual of its equation, and the last
/// change. An iteration needs the forces of one trial. The vectors contain followed
/// particles only.
class CriticalMode {
 public:
  /// `mass` and `particles` must outlive this object.
  CriticalMode(const std::vector<Real>& mass, const FollowedParticles& particles)
      : mass_(mass), particles_(particles) {}

  /// Begins a new search with the trial `start`. Memory is reused between searches.
  void begin(std::span<const NodalVector> start);

  TrialMode mode;   ///< the present mode; empty before the first trial
  TrialMode trial;  ///< the next trial; the caller fills in its forces

  ModeRates rates(const TrialMode& of) const;
  /// Sets the next trial to the residual: trial.w = M^-1 A w - lambda w of the mode w.
  void propose_trial(Real dt);
  /// Replaces the mode by the best combination of the mode, the trial and the last change. The
  /// first trial becomes the mode without change. The contents of the trial are lost.
  void include_trial(Real dt);

 private:
  /// The vector A w at particle A.
  Lanes force(const TrialMode& of, Real dt, Index A) const;

  const std::vector<Real>& mass_;
  const FollowedParticles& particles_;
  TrialMode way_;  // last change of the mode; empty at first
};

}  // namespace meniscus
