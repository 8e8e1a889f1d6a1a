// SPDX-License-Identifier: BSD-3-Clause
// Cavity: a closed surface filled with a pressure, or with a content of prescribed volume.
#pragma once
#include "input/ramp.hpp"
#include "physics/surface/closed_surface.hpp"

#include <memory>
#include <optional>

namespace meniscus {

/// At most one of `pressure` and `volume_target`; with neither the cavity is vented.
struct CavityFilling {
  std::optional<Real> pressure;       ///< inside above outside
  std::optional<Real> volume_target;  ///< of the volume V0 enclosed in the reference
  Real penalty = 0;                   ///< pressure per relative deviation from the target
  Ramp ramp;                          ///< from pressure 0 or target 1
};

/// Pressure: stored energy E = -p (V - V0). Content: E = penalty V0 (V/V0 - target)^2 / 2, that is
/// p = -penalty (V/V0 - target). The force is p dV/dd, the exact gradient; what changes with time
/// is work of the outside world. When opposite places of an inner surface touch, that is a failure.
template <int D>
std::unique_ptr<ForceTerm> cavity(const Body<D>& body, SurfacePart part,
                                  const CavityFilling& filling, int points);

}  // namespace meniscus
