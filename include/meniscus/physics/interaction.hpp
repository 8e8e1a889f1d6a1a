// SPDX-License-Identifier: BSD-3-Clause
// Interactions of two surfaces, whatever their origin: energy, pressure and stiffness per area as
// functions of the gap between them.
#pragma once
#include "meniscus/core/types.hpp"
#include "meniscus/core/units.hpp"

#include <optional>
#include <string>

namespace meniscus {

/// Two flat surfaces with a gap g between them: e(g) energy per area, zero far apart, p = -e'
/// pressure (negative: attraction), K = -p' stiffness.
struct PlaneState {
  Real energy, pressure, stiffness;
};

/// What it means for two flat bodies.
struct PlaneContact {
  Real equilibrium_gap;  ///< p = 0
  Real adhesion;         ///< W = -e at the equilibrium gap
  Real peak_traction;    ///< largest attraction -p
  Real peak_gap;         ///< where it is
  Real stiffness;        ///< K at the equilibrium gap
  Real softening;        ///< largest -K; elastic stiffness per area below it jumps into contact
  Real softening_gap;    ///< where it is
  Real uncut_adhesion;   ///< W without the cut-off

  /// Part of the adhesion that the cut-off costs.
  Real lost_adhesion() const { return 1 - adhesion / uncut_adhesion; }
};

class AdhesionPattern;

class Interaction {
 public:
  virtual ~Interaction() = default;

  /// At a gap of at least least_gap().
  virtual PlaneState at(Real gap) const = 0;
  /// Gap beyond which it is too weak to matter to a step.
  virtual Real range() const = 0;
  /// Steps into a narrower gap are rejected.
  virtual Real least_gap() const = 0;
  /// Whether its stiffness may grow by multiples within a step that closes a twentieth of the gap,
  /// so that a step has to resolve the motion in it; otherwise stability alone limits steps.
  virtual bool hardens() const { return true; }
  /// Whether there is nothing at all beyond range().
  virtual bool ends() const { return false; }
  /// The k of a pressure that falls as gap^-k beyond the peak of the traction; none: in another
  /// way.
  virtual std::optional<int> far_power() const { return std::nullopt; }
  virtual PlaneContact flat() const = 0;
  /// The adhesion W(x, t) of a rigid partner or ground, or W(t) between two bodies, by which at()
  /// has to be multiplied; null: at() has it. flat() has that of one place.
  virtual const AdhesionPattern* pattern() const { return nullptr; }
  /// Its lengths and formulas in words, for the log; empty: flat() says it all.
  virtual std::string described(const UnitSystem&) const { return {}; }
  /// Why it may be wrong on facets of that size, if it may.
  virtual std::optional<std::string> doubt([[maybe_unused]] Real facet) const {
    return std::nullopt;
  }
};

}  // namespace meniscus
