// SPDX-License-Identifier: BSD-3-Clause
// The report of `meniscus check` on bodies that are read from mesh files.
#pragma once
#include "scene/scene.hpp"

namespace meniscus {

/// Prints for each body with shape = "mesh": the number and kind of cells; whether the surface is
/// closed; the area; the signed volume that the surface encloses, and the volume of the cells; the
/// smallest nodal cell; and the smallest row sum, relative to the volume of its nodal cell.
template <int D>
void say_meshes(const Scene<D>& scene, const SceneInput& input);

}  // namespace meniscus
