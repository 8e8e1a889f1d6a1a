// SPDX-License-Identifier: BSD-3-Clause
// Plan of a scene: its input, read and checked before particles are made.
#pragma once
#include "meniscus/scene/load.hpp"
#include "scene/settings.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// Settings of a run that do not depend on its bodies and loads.
struct RunSettings {
  std::string title;
  UnitSystem units;
  InitialSettings initial;
  TimeSettings time;
  OutputSettings output;
  std::vector<std::pair<std::string, ExpectSettings>> expectations;
  std::string complete;  ///< all keys with their values, as of SceneInput::complete()
};

/// The input of a scene. It is constant after reading; scenes can be built from it any number of
/// times.
template <int D>
struct Plan : RunSettings {
  BodyPlans<D> bodies;
  std::vector<std::unique_ptr<const Load<D>>> loads;  ///< in the order in which they are built
};

/// The dimension of a scene, 2 or 3, of the grids of its bodies: 2 if it is axisymmetric. Throws
/// InputError if the scene has none.
int scene_dimension(const SceneInput& input);

/// Reads the whole scene. Throws InputError with all problems of the input at once.
template <int D>
Plan<D> read_plan(const SceneInput& input);

}  // namespace meniscus
