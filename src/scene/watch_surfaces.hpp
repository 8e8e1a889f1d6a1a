// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of a scene that must not go through themselves or each other.
#pragma once
#include "scene/scene.hpp"

namespace meniscus {

/// Adds the checks of all surfaces to the scene. At its beginning, throws InputError for bodies
/// that overlap or a surface that crosses itself, and notes the pairs of bodies that no contact
/// keeps apart.
template <int D>
void watch_surfaces(Scene<D>& scene, bool begins);

}  // namespace meniscus
