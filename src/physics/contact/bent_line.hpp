// SPDX-License-Identifier: BSD-3-Clause
// The contact line of a drop whose surface bends within the range of an interaction: the wall on
// which the drop has Young's angle (wetting note 12).
#pragma once
#include "physics/contact/gap/interaction.hpp"

namespace meniscus {

/// The line of a cap (2D: circular segment) at rest on a plane. The sharp line is where its sphere
/// meets the wall.
struct BentLine {
  Real depth = 0;   ///< of the wall below the film; negative: above it
  Real beyond = 0;  ///< radius of the sharp line - radius of a disk of the area energy / adhesion
  Real radius = 0;  ///< of the sharp line
};

/// The line of a drop with this volume (2D: area) and surface tension gamma that adheres by
/// `adhesion`. Its sphere meets the wall at Young's angle, or at the angle that line_tension() of
/// the interaction makes of it. Angles below 15 degrees count as 15. All entries are 0 if the drop
/// is too small for the range, or if the interaction does not end: it then bends all of the
/// surface.
BentLine bent_line(const Interaction& interaction, Real adhesion, Real gamma, Real volume,
                   int dimension);

/// Radius of the base of a cap with the contact angle theta in radians and the volume 1 (2D: half
/// the width, area 1).
Real base_of_cap(Real theta, int dimension);

}  // namespace meniscus
