// SPDX-License-Identifier: BSD-3-Clause
// Small scenes with every registered load, for the tests that run over all of them. A new load
// brings its own with register_entry(LoadExample{...}) in one file of the tests.
#pragma once
#include "meniscus/core/registry.hpp"
#include "meniscus/scene/simulation.hpp"

#include <string>
#include <string_view>

namespace meniscus::test {

struct LoadExample {
  static constexpr const char* kind = "example of a load";
  std::string_view name;         ///< that of the load, with a suffix after a dot
  std::string (*bodies)(int D);  ///< one of those below
  std::string (*tables)(int D);  ///< the load; empty in a dimension that it does not have
  bool conservative;             ///< its force is minus the gradient of its stored energy
  bool closed;                   ///< without net force and net torque

  std::string_view load() const { return name.substr(0, name.find('.')); }
  std::string scene(int D) const;  ///< text of the whole scene
};

/// A fluid ball (2D: disk) 'drop' of radius 1 about the origin.
std::string one_drop(int D);
/// And an elastic one, 'other', that moves towards it, their surfaces 0.2 apart.
std::string two_drops(int D);
/// A hollow elastic 'shell' of outer radius 2.
std::string one_shell(int D);

template <int D>
Scene<D> scene_of(const std::string& text) {
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  return build_scene<D>(input);
}

}  // namespace meniscus::test
