// SPDX-License-Identifier: BSD-3-Clause
// Audit: energies by kind, and the errors of the conservation of energy and momenta.
#pragma once
#include "solve/system.hpp"

#include <map>
#include <string>

namespace meniscus {

/// Energies and momenta of a state, over all bodies.
struct Ledger {
  Real kinetic = 0;
  std::map<std::string, Real> stored;  ///< by kind of energy: "strain", "surface", ...
  Real dissipated = 0, external_work = 0;
  Real remapped = 0;  ///< energy that remaps added
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();  ///< about the origin; 2D: z only
  /// Change of the momenta since the start that the impulses from outside do not explain.
  Eigen::Vector3d momentum_excess = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_momentum_excess = Eigen::Vector3d::Zero();
  Real impulses = 0, angular_impulses = 0;  ///< sums of the sizes of impulses from outside

  /// The quantity that is constant in an exact solution: kinetic + stored + dissipated - external
  /// work - remapped.
  Real balance() const;
};

/// The ledger of a state.
template <int D>
Ledger take_ledger(const System<D>& system, const State& state);

/// Compares ledgers with the start of a run. Part of a checkpoint.
struct Audit {
  Real initial_balance = 0;
  std::map<std::string, Real> initial_stored;
  Real energy_scale = 0;    ///< largest energy exchanged so far
  Real momentum_scale = 0;  ///< largest sqrt(2 M E_kin) so far, or impulses if they are more
  Real angular_momentum_scale = 0;  ///< likewise, with sqrt(2 M E_kin) times the radius of gyration

  void begin(const Ledger& ledger);
  /// `dimension`: 2 or 3.
  void archive(const Archive& a, int dimension);
  /// Widens the scales.
  template <int D>
  void follow(const System<D>& system, const State& state, const Ledger& ledger);

  /// Change of the balance relative to the energy exchanged so far. 0 before any energy was
  /// exchanged.
  Real balance_error(const Ledger& ledger) const;
  /// Size of the unexplained change of the momentum, relative to its scale.
  Real momentum_error(const Ledger& ledger) const;
  Real angular_momentum_error(const Ledger& ledger) const;
};

}  // namespace meniscus
