// SPDX-License-Identifier: BSD-3-Clause
// Makes the director of a nematic body a field of the scene.
#pragma once
#include "meniscus/scene/assembly.hpp"
#include "physics/director/nematic_numbers.hpp"

namespace meniscus {

/// Adds the director of `body`. All bodies of `scene` must have their particles; `assembly` must
/// belong to the same scene.
template <int D>
void add_director(const Body<D>& body, NematicBody<D> nematic, Scene<D>& scene,
                  Assembly<D>& assembly);

}  // namespace meniscus
