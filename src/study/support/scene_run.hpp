// SPDX-License-Identifier: BSD-3-Clause
// A scene as a measurement of a study.
#pragma once
#include "run/simulation.hpp"
#include "study/study.hpp"

#include <string>

namespace meniscus::study {

/// Runs a scene to its end. The result has its number of particles, memory and times, and 1/level
/// as h. results(scene, motion, measurement) adds the errors and values of the last state.
template <int D, class Results>
Measurement measure_scene(const std::string& text, const std::string& method, int level,
                          Results&& results) {
  const Stopwatch set_up;
  const SceneInput input = SceneInput::from_text(text);
  scene_dimension(input);
  Scene<D> scene = build_scene<D>(input);
  Simulation<D> simulation(scene);
  simulation.begin();
  Measurement measurement{.method = method, .level = level};
  measurement.particles = scene.system.size();
  measurement.h = 1.0 / level;
  measurement.bytes = scene.system.bytes();
  measurement.set_up = set_up.seconds();
  const Stopwatch run;
  simulation.settle();
  while (!simulation.finished()) simulation.advance();
  measurement.time = run.seconds();
  results(scene, simulation.state().motion(), measurement);
  return measurement;
}

}  // namespace meniscus::study
