// SPDX-License-Identifier: BSD-3-Clause
// Cases: small scenes with everything registered, for tests that run over all of it. They consist
// of the examples that registered items give for `meniscus keys`.
#pragma once
#include "run/simulation.hpp"
#include "scene/example_scenes.hpp"

#include <string>
#include <vector>

namespace meniscus::test {

/// Properties claimed of the forces of a case.
struct Claims {
  bool gradient = false;  ///< minus the gradient of the energy that they store
  bool balanced = false;  ///< without net force and net torque
};

struct Case {
  std::string name;   ///< e.g. "load cavity"
  std::string scene;  ///< text of the whole scene
  Claims claims;
  bool own_bodies = false;  ///< also tests the forces of the bodies themselves
};

/// All cases in D dimensions: the example of every load, surface law, interaction with every rigid
/// partner, material, shape and solver, and variants of some.
template <int D>
const std::vector<Case>& cases();

/// Names the items registered without an example; empty if there are none.
template <class Registry>
std::vector<std::string> missing_examples(const Registry& registry, const std::string& what) {
  std::vector<std::string> missing;
  for (const auto& [name, entry] : registry)
    if (entry.example.empty())
      missing.push_back(
          what + " '" + name +
          "' brings no example: give its struct `static constexpr std::string_view example`, the "
          "lines of a scene with the keys that it needs. Bodies of the tests are \"drop\", a ball "
          "of radius 1 about the origin, \"other\", a second one beside it, and \"shell\"");
  return missing;
}

using meniscus::one_drop;
using meniscus::one_shell;
using meniscus::two_drops;

template <int D>
Scene<D> scene_of(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  return build_scene<D>(input);
}

/// The terms under test in a case. The scene lists the terms of the bodies before them.
template <int D>
std::span<const std::unique_ptr<ForceTerm>> own_terms(const Case& c, const Scene<D>& scene) {
  return std::span(scene.system.terms).subspan(c.own_bodies ? 0 : scene.system.bodies.size());
}

}  // namespace meniscus::test
