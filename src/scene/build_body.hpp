// SPDX-License-Identifier: BSD-3-Clause
// From a planned body to particles, internal force and measures.
#pragma once
#include "meniscus/scene/assembly.hpp"
#include "physics/director/nematic_numbers.hpp"

namespace meniscus {

/// Adds the body to the system of `scene`, its rows divided so, on a reference of its own unless
/// that is null, with particles but without rows. All ranks call this.
template <int D>
void place_body(const BodyPlan<D>& planned, const Division& division,
                std::shared_ptr<const Reference<D>> reference, Scene<D>& scene,
                Assembly<D>& assembly);

/// The rows of this rank of a body that was placed: the part of building it that no rank waits for
/// others in, so that ranks do it side by side for small bodies. Throws SolveError where shape
/// functions cannot be determined.
template <int D>
void build_rows(const BodyPlan<D>& planned, Body<D>& body);

/// The rest of a body that has rows: masses, internal force and measures. What a nematic is beside
/// a fluid, which waits for the particles of all bodies; null for other materials. All ranks call
/// this.
template <int D>
std::unique_ptr<NematicBody<D>> build_body(const BodyPlan<D>& planned, Body<D>& body,
                                           Scene<D>& scene, Assembly<D>& assembly);

}  // namespace meniscus
