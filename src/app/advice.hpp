// SPDX-License-Identifier: BSD-3-Clause
// What the numbers of a scene mean, and what would save steps: printed by `meniscus check`.
#pragma once
#include "app/commands.hpp"
#include "input/input.hpp"
#include "scene/scene.hpp"

namespace meniscus {

/// Units of forces and pressures in those of SI, if the scene has others.
void say_units(const UnitSystem& units);

/// Ohnesorge number and times of every drop, and its Bond number if a constant body force acts on
/// it.
template <int D>
void say_drop_numbers(const Scene<D>& scene, const SceneInput& input);

/// Bulk moduli of drops that are a hundred times what compresses them, and how many times fewer
/// steps they would take than those of the scene: by building it with them. `stable` is its stable
/// step. Nothing if there is little to gain.
template <int D>
void say_softer_drops(const Scene<D>& scene, const RunRequest& request, Real stable);

/// Warns of contacts without force at the start between bodies that nothing moves: they have no
/// velocity and no net force, and no load changes with time. `state` is that of the start, with its
/// forces.
template <int D>
void warn_of_idle_contacts(const Scene<D>& scene, const State& state);

}  // namespace meniscus
