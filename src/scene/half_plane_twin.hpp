// SPDX-License-Identifier: BSD-3-Clause
// The twin of a 3D scene whose bodies are of revolution about a common axis.
#pragma once
#include "scene/plan.hpp"

#include <string>
#include <vector>

namespace meniscus {

/// A scene with `dimension = "axisymmetric"` and the same numbers of cells.
struct HalfPlaneTwin {
  std::string text;                ///< TOML
  Index particles = 0;             ///< of its bodies
  std::vector<std::string> notes;  ///< sentences about what differs, such as measures left out
};

/// The twin of a scene. Its axis is parallel to x, y or z, passes through the bodies, and becomes
/// the axis y of the half plane. Formulas are compared at particles and at their images turned
/// about the axis. Throws InputError with the place of a value that is not of revolution, and the
/// reason. Builds the twin.
HalfPlaneTwin half_plane_twin(const SceneInput& input, const Plan<3>& plan);

}  // namespace meniscus
