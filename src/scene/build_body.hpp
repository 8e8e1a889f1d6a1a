// SPDX-License-Identifier: BSD-3-Clause
// From a planned body to particles, internal force and measures.
#pragma once
#include "meniscus/physics/nematic.hpp"
#include "meniscus/scene/assembly.hpp"

namespace meniscus {

/// Adds the body to `scene`, its rows divided so, on a reference of its own unless that is null;
/// the assembly is of the same scene. What a nematic is beside a fluid, which waits for the
/// particles of all bodies; null for other materials.
template <int D>
std::unique_ptr<NematicBody<D>> build_body(const BodyPlan<D>& planned, const Division& division,
                                           std::shared_ptr<const Reference<D>> reference,
                                           Scene<D>& scene, Assembly<D>& assembly);

}  // namespace meniscus
