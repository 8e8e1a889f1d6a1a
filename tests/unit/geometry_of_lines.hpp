// SPDX-License-Identifier: BSD-3-Clause
// The geometry of a body for tests, from the lines of its table in a scene.
#pragma once
#include "meniscus/body/shapes.hpp"

#include <string>

namespace meniscus::test {

/// Throws InputError if the lines are wrong.
template <int D>
Geometry<D> geometry_of_lines(const std::string& lines) {
  const SceneInput scene = SceneInput::from_text("[body]\n" + lines);
  const Block block = *scene.root().table("body");
  Geometry<D> geometry = read_geometry<D>(block);
  block.done();
  scene.check();
  return geometry;
}

}  // namespace meniscus::test
