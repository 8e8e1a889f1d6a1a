// SPDX-License-Identifier: BSD-3-Clause
// Interaction of two flat bodies: adhesion, equilibrium gap, strength, stiffness.
#pragma once
#include "meniscus/physics/contact_law.hpp"

#include <optional>
#include <string>

namespace meniscus {

/// Two half spaces (half planes) with a gap g between them: e(g) energy per area, zero far apart,
/// p = -e' pressure (negative: attraction), K = -p' stiffness. The kernel `planar` counts per
/// length and depth.
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

/// `beta_product`: beta1 beta2 of the two bodies. Closed form without a cut-off (CGCM note 3.1);
/// with one all is exact to rounding, but softening_gap to half the digits.
PlaneContact plane_contact(const ContactLaw& law, Real beta_product);

/// Energy, pressure and stiffness of two half spaces at the gap g > 0.
struct PlaneState {
  Real energy, pressure, stiffness;
};
PlaneState plane_state(const ContactLaw& law, Real beta_product, Real gap);

/// The angle in radians at which a liquid with surface tension gamma meets a rigid plane to which
/// it adheres, cos theta = W/gamma - 1 (Young-Dupre); none where W >= 2 gamma: complete wetting.
std::optional<Real> contact_angle(Real adhesion, Real gamma);

/// "61.3 degrees" or "complete wetting".
std::string contact_angle_text(Real adhesion, Real gamma);

}  // namespace meniscus
