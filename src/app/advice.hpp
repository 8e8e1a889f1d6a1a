// SPDX-License-Identifier: BSD-3-Clause
// Advice on the numbers of a scene, printed by `meniscus check`: dimensionless numbers, and changes
// that save steps.
#pragma once
#include "app/commands.hpp"
#include "input/input.hpp"
#include "scene/scene.hpp"

namespace meniscus {

/// Prints the units of force and pressure of the scene in SI units, unless the scene uses SI units.
void say_units(const UnitSystem& units);

/// Prints the Ohnesorge number and the characteristic times of every drop, and its Bond number if a
/// constant body force acts on it.
template <int D>
void say_drop_numbers(const Scene<D>& scene, const SceneInput& input);

/// Proposes, for each drop, a bulk modulus of a hundred times the pressure that compresses the
/// drop. Builds the scene with the proposed moduli and prints how many times fewer steps it would
/// take. `stable` is the stable step of the given scene. Prints nothing if there is little to gain.
template <int D>
void say_softer_drops(const Scene<D>& scene, const RunRequest& request, Real stable);

/// Warns of contacts that exert no force at the start while nothing moves their bodies together:
/// the bodies have no velocity and no net force, and no load changes with time. `state` is the
/// initial state with its forces.
template <int D>
void warn_of_idle_contacts(const Scene<D>& scene, const State& state);

}  // namespace meniscus
