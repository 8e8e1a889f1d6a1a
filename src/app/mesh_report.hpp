// SPDX-License-Identifier: BSD-3-Clause
// What `meniscus check` says of bodies of mesh files.
#pragma once
#include "scene/scene.hpp"

namespace meniscus {

/// Of each body with shape = "mesh": its cells, whether its surface is closed, the volume within it
/// with its sign and that of the cells, its area, the smallest nodal cell, and the smallest row sum
/// over the volume of its nodal cell.
template <int D>
void say_meshes(const Scene<D>& scene, const SceneInput& input);

}  // namespace meniscus
