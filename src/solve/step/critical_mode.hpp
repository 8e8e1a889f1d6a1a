// SPDX-License-Identifier: BSD-3-Clause
// The mode that is the first to become unstable, from the forces that trial changes cause.
#pragma once
#include "parallel/halo.hpp"

#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace meniscus {

/// A change of the places, or of the velocities, and the forces against it: K w, and C w where
/// there is viscosity.
struct TrialMode {
  NodalScratch w, Kw, Cw;
};

/// k = w.Kw / w.Mw and c = w.Cw / w.Mw of a mode.
struct ModeRates {
  Real stiffness = 0, viscosity = 0;

  /// Of central differences with a lagged viscous force: 2/omega without viscosity, 2/c without
  /// stiffness.
  Real longest_step() const {
    return 4 / (viscosity + std::sqrt(viscosity * viscosity + 4 * stiffness));
  }
};

/// Conjugate gradients for the greatest eigenvalue of A = dt^2/4 K + dt/2 C against the masses
/// (Knyazev, SIAM J. Sci. Comput. 23 (2001) 517, for one mode): of the mode found so far, of what
/// is left of its equation and of the way it has come the best combination is the next. Each takes
/// the forces of one trial. In a halo all are of the particles that the rank follows.
class CriticalMode {
 public:
  /// Both have to last.
  CriticalMode(const std::vector<Real>& mass, const std::shared_ptr<Halo>& halo)
      : mass_(mass), halo_(halo) {}

  /// The first trial, of a new search. Memory is kept from search to search.
  void begin(std::span<const NodalVector> start);

  TrialMode mode;   ///< found so far; empty before the first trial
  TrialMode trial;  ///< to be tried next: its forces are to be filled in by the caller

  ModeRates rates(const TrialMode& of) const;
  /// trial.w = M^-1 A w - lambda w of the mode.
  void propose_trial(Real dt);
  /// The best combination becomes the mode, the first trial as it is; the trial is used up.
  void include_trial(Real dt);

 private:
  /// A w of particle A.
  Lanes force(const TrialMode& of, Real dt, Index A) const;

  const std::vector<Real>& mass_;
  const std::shared_ptr<Halo>& halo_;
  TrialMode way_;  // none in the beginning
};

}  // namespace meniscus
