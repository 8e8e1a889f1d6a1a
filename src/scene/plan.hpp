// SPDX-License-Identifier: BSD-3-Clause
// Plan of a scene: its input, read and checked before anything large is built.
#pragma once
#include "meniscus/scene/load.hpp"
#include "scene/settings.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

/// The parts of a scene that say how it is run, whatever is in it.
struct RunSettings {
  std::string title;
  UnitSystem units;
  TimeSettings time;
  OutputSettings output;
  std::vector<std::pair<std::string, ExpectSettings>> expectations;
};

/// Never changes once it is read; anything can be built from it any number of times.
template <int D>
struct Plan : RunSettings {
  BodyPlans<D> bodies;
  std::vector<std::unique_ptr<const Load<D>>> loads;  ///< as they are built
};

/// 2 or 3. Throws InputError if the scene does not say.
int scene_dimension(const SceneInput& input);

/// Reads the whole scene. Throws InputError with all problems of the input at once.
template <int D>
Plan<D> read_plan(const SceneInput& input);

}  // namespace meniscus
