// SPDX-License-Identifier: BSD-3-Clause
// The director of a nematic body becomes a field of the scene.
#pragma once
#include "meniscus/scene/assembly.hpp"
#include "physics/director/nematic_numbers.hpp"

namespace meniscus {

/// All bodies of `scene` have their particles; the assembly is of the same scene.
template <int D>
void add_director(const Body<D>& body, NematicBody<D> nematic, Scene<D>& scene,
                  Assembly<D>& assembly);

}  // namespace meniscus
