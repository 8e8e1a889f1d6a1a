// SPDX-License-Identifier: BSD-3-Clause
// Checks that no surface of a scene passes through itself or another surface.
#pragma once
#include "scene/scene.hpp"

namespace meniscus {

/// Adds the checks of all surfaces to the scene. If `begins`, also throws InputError for bodies
/// that overlap and surfaces that cross themselves, and notes pairs of bodies without a contact.
template <int D>
void watch_surfaces(Scene<D>& scene, bool begins);

}  // namespace meniscus
