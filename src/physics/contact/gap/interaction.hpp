// SPDX-License-Identifier: BSD-3-Clause
// Interactions of two surfaces: energy, pressure and stiffness per area as functions of the gap.
#pragma once
#include "input/units.hpp"
#include "numbers/types.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// Two flat surfaces with a gap g: energy per area e(g), zero far apart; pressure p = -e'
/// (negative: attraction); stiffness K = -p'.
struct PlaneState {
  Real energy, pressure, stiffness;
};

/// Characteristic numbers of an interaction for two flat bodies.
struct PlaneContact {
  Real equilibrium_gap;  ///< p = 0
  Real adhesion;         ///< W = -e at the equilibrium gap
  Real peak_traction;    ///< largest attraction -p
  Real peak_gap;         ///< gap at the largest attraction
  Real stiffness;        ///< K at the equilibrium gap
  Real softening;        ///< largest -K; softer elastic surfaces jump into contact
  Real softening_gap;    ///< gap at this -K
  Real uncut_adhesion;   ///< W without the cut-off

  /// The part of the adhesion that is lost by the cut-off.
  Real lost_adhesion() const { return 1 - adhesion / uncut_adhesion; }
};

class AdhesionPattern;

class Interaction {
 public:
  virtual ~Interaction() = default;

  /// Energy, pressure and stiffness at a gap of at least least_gap().
  virtual PlaneState at(Real gap) const = 0;
  /// The gap beyond which the interaction is too weak to limit a step.
  virtual Real range() const = 0;
  /// The smallest gap: steps into a narrower gap are rejected.
  virtual Real least_gap() const = 0;
  /// True if the stiffness may grow by multiples while a step closes a twentieth of the gap. A step
  /// then has to resolve the motion in it; otherwise only stability limits steps.
  virtual bool hardens() const { return true; }
  /// True if the interaction is exactly zero beyond range().
  virtual bool ends() const { return false; }
  /// Distance from the surface of a rigid partner down to the surface inside it from which gaps
  /// count.
  virtual Real recess() const { return 0; }
  /// The exponent k of a pressure that falls as gap^-k beyond the peak of the traction; empty if it
  /// falls in another way.
  virtual std::optional<int> far_power() const { return std::nullopt; }
  virtual PlaneContact flat() const = 0;
  /// The adhesion W(x, t) of a rigid partner or ground, or W(t) between two bodies, as a factor of
  /// at(). Null if at() contains the adhesion. flat() uses the adhesion at one place.
  virtual const AdhesionPattern* pattern() const { return nullptr; }
  /// Energy per length of the contact line that a drop is meant to have.
  virtual Real line_tension() const { return 0; }
  /// The lengths that it chose, and formulas, as text for the log; empty if flat() is a complete
  /// description.
  virtual std::string described(const UnitSystem&) const { return {}; }
  /// The keys that the scene leaves to the size of the facets, and their values.
  virtual std::vector<std::pair<std::string, Real>> lengths_by_facets() const { return {}; }
  /// A warning if the interaction may be wrong on facets of size `facet`.
  virtual std::optional<std::string> doubt([[maybe_unused]] Real facet) const {
    return std::nullopt;
  }
};

}  // namespace meniscus
