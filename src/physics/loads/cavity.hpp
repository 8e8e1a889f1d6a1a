// SPDX-License-Identifier: BSD-3-Clause
// Cavity: a closed surface filled with a pressure, or with a content of prescribed volume.
#pragma once
#include "input/ramp.hpp"
#include "physics/surface/closed_surface.hpp"

#include <memory>
#include <optional>

namespace meniscus {

/// How a cavity is filled. At most one of `pressure` and `volume_target` is set; without both, the
/// cavity is open.
struct CavityFilling {
  std::optional<Real> pressure;       ///< inside minus outside
  std::optional<Real> volume_target;  ///< relative to the volume V0 enclosed in the reference
  Real penalty = 0;                   ///< pressure per relative deviation from the target
  Ramp ramp;                          ///< from pressure 0 or target 1
};

/// The force of a filled cavity. With a pressure, the stored energy is E = -p (V - V0). With a
/// content, E = penalty V0 (V/V0 - target)^2 / 2, so p = -penalty (V/V0 - target). The force p
/// dV/dd is the exact gradient. Work due to the change of pressure or target with time is external
/// work. Opposite parts of an inner surface that touch are a failure.
template <int D>
std::unique_ptr<ForceTerm> cavity(const Body<D>& body, SurfacePart part,
                                  const CavityFilling& filling, int points);

}  // namespace meniscus
