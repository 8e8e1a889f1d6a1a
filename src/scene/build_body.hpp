// SPDX-License-Identifier: BSD-3-Clause
// From a planned body to particles, internal force and measures.
#pragma once
#include "meniscus/scene/assembly.hpp"

namespace meniscus {

/// Adds the body to `scene`, on a reference of its own unless that is null; the assembly is of the
/// same scene.
template <int D>
void build_body(const BodyPlan<D>& planned, std::shared_ptr<const Reference<D>> reference,
                Scene<D>& scene, Assembly<D>& assembly);

}  // namespace meniscus
