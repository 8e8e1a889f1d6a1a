// SPDX-License-Identifier: BSD-3-Clause
// The state of a system in motion: what changes from step to step.
#pragma once
#include "meniscus/physics/force_term.hpp"
#include "state/archive.hpp"

namespace meniscus {

/// Throws FileError if what an archive has read is out of its range: the file was changed.
void require_saved(bool in_range, const Archive& a, std::string_view name);

/// Heat, work and impulses so far, and the powers and forces of now that go on into the next step.
///
/// A step is kick, drift, kick, so that its impulses are dt/2 f at its beginning and at its end,
/// and its angular impulses dt/2 x cross f with the places x there: exact, whatever the step.
struct Books {
  Real dissipated = 0;                      ///< heat so far
  Real external_work = 0;                   ///< work of the outside world so far
  Real remapped = 0;                        ///< energy that came by new references so far
  Real heat = 0;                            ///< power turned into heat
  Real external_power = 0, load_power = 0;  ///< of Report and ForceTerm
  Resultant outside;                        ///< of Report

  /// Sum of m v and of m x cross v, as they were at the beginning, with all impulses from outside
  /// since then.
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();
  Real impulses = 0, angular_impulses = 0;  ///< sums of the sizes of these impulses

  /// The powers at the beginning of a run.
  void begin(const Report& report, Real load_power);
  /// A step of dt ended with these powers; `last_share` of its heat came at the power of now, the
  /// rest at that of before.
  void add(const Report& report, Real load_power, Real dt, Real last_share = 0.5);
  /// The outside acted with this force and moment for a time of dt.
  void push(const Resultant& by, Real dt);
  /// All velocities were multiplied by a factor, as by damping.
  void scale_momenta(Real factor);
  void archive(const Archive& a, int dimension);
};

/// A run continues bit for bit from a copy of its state.
struct State {
  Real time = 0;
  std::int64_t step = 0;
  std::int64_t epoch = 0;       ///< how often bodies were referred anew
  NodalVectors u, v;            ///< displacement and velocity coefficients at `time`
  NodalVectors force;           ///< at u and the velocity of the last half step
  std::vector<Unknown> fields;  ///< other unknowns
  Reactions reactions;          ///< of constraints, part of `force`; empty without any
  Books books;
  StepDemand demand;                   ///< of all terms on the next step
  bool energies_asked = false;         ///< at the end of the next step
  std::vector<StoredEnergy> energies;  ///< that came along with `force`; any may be missing

  Motion motion() const { return {time, u, v, fields, &reactions}; }
  /// For forces to be computed anew: the energies of those before are void.
  Forces forces() {
    energies.clear();
    Forces all(force, fields);
    if (energies_asked) all.energies = &energies;
    return all;
  }
  /// In 2 or 3 dimensions; the sizes are those of the system already.
  void archive(const Archive& a, int dimension);
};

}  // namespace meniscus
