// SPDX-License-Identifier: BSD-3-Clause
// The state of a system in motion: what changes from step to step.
#pragma once
#include "meniscus/core/archive.hpp"
#include "meniscus/physics/force_term.hpp"

namespace meniscus {

/// Throws FileError if what an archive has read is out of its range: the file was changed.
void require_saved(bool in_range, const Archive& a, std::string_view name);

/// Heat and work so far, and the powers of now that go on into the next step.
struct Books {
  Real dissipated = 0;                      ///< heat so far
  Real external_work = 0;                   ///< work of the outside world so far
  Real remapped = 0;                        ///< energy that came by new references so far
  Real heat = 0;                            ///< power turned into heat
  Real external_power = 0, load_power = 0;  ///< of Report and ForceTerm

  /// The powers at the beginning of a run.
  void begin(const Report& report, Real load_power);
  /// A step of dt ended with these powers; `last_share` of its heat came at the power of now, the
  /// rest at that of before.
  void add(const Report& report, Real load_power, Real dt, Real last_share = 0.5);
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
