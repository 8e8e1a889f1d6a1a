// SPDX-License-Identifier: BSD-3-Clause
// The state of a system: the values that change from step to step.
#pragma once
#include "meniscus/physics/force_term.hpp"
#include "state/archive.hpp"

namespace meniscus {

/// Throws FileError if a value that was read from an archive is out of its range.
void require_saved(bool in_range, const Archive& a, std::string_view name);

/// The books: heat, work and impulses so far, and the present powers and forces, which the next
/// step needs.
///
/// A step is kick, drift, kick. Its impulses are therefore dt/2 f at its begin and at its end, and
/// its angular impulses dt/2 x cross f with the positions x there. This is exact for any step.
struct Books {
  Real dissipated = 0;                      ///< heat so far
  Real external_work = 0;                   ///< work from outside so far
  Real remapped = 0;                        ///< energy added by remaps so far
  Real last_remap = 0;                      ///< energy added by the last remap
  Real dissipated_at_remap = 0;             ///< heat until then
  Real heat = 0;                            ///< present power turned into heat
  Real external_power = 0, load_power = 0;  ///< present values, of Report and ForceTerm
  Resultant outside;                        ///< of Report

  /// Sums of m v and of m x cross v at the start, plus all impulses from outside since then.
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();
  Real impulses = 0, angular_impulses = 0;  ///< sums of the sizes of these impulses

  /// Sets the powers at the start of a run.
  void begin(const Report& report, Real load_power);
  /// Adds a step of dt that ended with these powers. A part `last_share` of its heat is at the new
  /// power, the rest at the power before.
  void add(const Report& report, Real load_power, Real dt, Real last_share = 0.5);
  /// Adds force dt to `momentum` and moment dt to `angular_momentum`. `by` holds the external force
  /// and moment that acted for the time dt.
  void push(const Resultant& by, Real dt);
  /// Adds the energy change of a remap.
  void remap(Real change);
  /// Accounts for velocities that were all multiplied by a factor, as by damping.
  void scale_momenta(Real factor);
  void archive(const Archive& a, int dimension);
};

/// The complete state. A run continues bit for bit from a copy of it.
struct State {
  Real time = 0;
  std::int64_t step = 0;
  std::int64_t epoch = 0;       ///< number of remaps so far
  NodalVectors u, v;            ///< displacement and velocity coefficients at `time`
  NodalVectors force;           ///< at u and the velocity of the last half step
  std::vector<Unknown> fields;  ///< other unknowns
  Reactions reactions;          ///< of constraints, part of `force`; empty without any
  Books books;
  StepDemand demand;            ///< limits of all terms for the next step
  bool energies_asked = false;  ///< true if terms compute energies at the end of the next step
  std::vector<StoredEnergy>
      energies;  ///< energies computed with `force`; some terms may be missing

  Motion motion() const { return {time, u, v, fields, &reactions}; }
  /// The arrays into which new forces are computed. Discards the energies of the old forces.
  Forces forces() {
    energies.clear();
    Forces all(force, fields);
    if (energies_asked) all.energies = &energies;
    return all;
  }
  /// Saves or restores the state. `dimension` is 2 or 3. Arrays must have the sizes of the system.
  void archive(const Archive& a, int dimension);
};

}  // namespace meniscus
