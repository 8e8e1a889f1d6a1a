// SPDX-License-Identifier: BSD-3-Clause
// Builds particles, internal force and measures of a planned body.
#pragma once
#include "meniscus/scene/assembly.hpp"
#include "physics/director/nematic_numbers.hpp"

namespace meniscus {

/// Adds a body with particles, but without rows, to the system of `scene`. `division`: how its rows
/// are divided between ranks. `reference`: its own reference configuration, or null for the
/// reference of the scene. All ranks must call this.
template <int D>
void place_body(const BodyPlan<D>& planned, const Division& division,
                std::shared_ptr<const Reference<D>> reference, Scene<D>& scene,
                Assembly<D>& assembly);

/// Computes the rows of this rank of a body that was placed. Ranks need not wait for each other
/// here, so they build small bodies in parallel. Throws SolveError if shape functions cannot be
/// determined.
template <int D>
void build_rows(const BodyPlan<D>& planned, Body<D>& body);

/// Adds masses, internal force and measures of a body with rows. For a nematic, returns its
/// director, which is completed when all bodies have particles; null for other materials. All ranks
/// must call this.
template <int D>
std::unique_ptr<NematicBody<D>> build_body(const BodyPlan<D>& planned, Body<D>& body,
                                           Scene<D>& scene, Assembly<D>& assembly);

}  // namespace meniscus
