// SPDX-License-Identifier: BSD-3-Clause
// Drops at rest on walls with a wetting interaction of finite range (wetting note 12): on planes,
// on balls and in a cavity, and between two plates, with the range and the offset that the program
// chooses. They have Young's contact angle at any range and curvature.
#include "study/study.hpp"
#include "study/support/scene_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace meniscus::contact_angle_study {
namespace {

/// A wall of radius B (B < 0: a cavity, 0: a plane), and the cap from which the drop begins.
struct Case {
  int dimension;
  Real angle, wall_radius = 0, start = 0;

  std::string name() const {
    const std::string wall =
        wall_radius == 0 ? "plane"
                         : fmt::format("{} of radius {:g}", wall_radius > 0 ? "ball" : "cavity",
                                       std::abs(wall_radius));
    return fmt::format("{}D {}, {:g} degrees", dimension, wall, angle);
  }
  std::string text(int core) const {
    const bool space = dimension == 3;
    const std::string partner =
        wall_radius == 0
            ? fmt::format("{{ type = \"half_space\", point = [0, 0{0}], normal = [0, {1}] }}",
                          space ? ", 0" : "", space ? "0, 1" : "1")
            : fmt::format("{{ type = \"{}\", centre = [0, {}{:g}], radius = {:g} }}",
                          wall_radius > 0 ? "ball" : "cavity", space ? "0, " : "", -wall_radius,
                          std::abs(wall_radius));
    return fmt::format(
        "dimension = {}\n[time]\nviscosity = \"implicit\"\nend = {}\n"
        "[[body]]\nname = \"drop\"\nshape = \"cap\"\nradius = 1\ncontact_angle = {}\n"
        "wall_radius = {}\ncore = {}\n{} = {}\n"
        "[body.material]\ntype = \"newtonian\"\ndensity = 1\nbulk_modulus = 151\nviscosity = 1\n"
        "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n"
        "[[contact]]\nname = \"wall\"\nbodies = [\"drop\"]\ncontact_angle = {}\npartner = {}\n",
        dimension, angle < 45 || angle > 140 ? 24 : 12, start > 0 ? start : std::min(angle, 150.0),
        wall_radius, core, space ? "layers" : "rings", core / 2, angle, partner);
  }
};

/// A plane drop between two plates, 1.01 below and above the centre of the disk from which it
/// begins.
struct Bridge {
  Real below, above;

  std::string name() const {
    return fmt::format("2D between plates, {:g} and {:g} degrees", below, above);
  }
  std::string text(int core) const {
    std::string text = fmt::format(
        "dimension = 2\n[time]\nviscosity = \"implicit\"\nend = 12\n"
        "[[body]]\nname = \"drop\"\nshape = \"disk\"\nradius = 1\ncore = {}\nrings = {}\n"
        "[body.material]\ntype = \"newtonian\"\ndensity = 1\nbulk_modulus = 151\nviscosity = 1\n"
        "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n",
        core, core / 2);
    for (const auto& [plate, angle, side] :
         {std::tuple{"below", below, -1.0}, std::tuple{"above", above, 1.0}})
      text += fmt::format(
          "[[contact]]\nname = \"{}\"\nbodies = [\"drop\"]\ncontact_angle = {}\n"
          "partner = {{ type = \"half_space\", point = [0, {}], normal = [0, {}] }}\n",
          plate, angle, 1.01 * side, -side);
    return text;
  }
};

Measurement run_bridge(const Bridge& bridge, int level) {
  return study::measure_scene<2>(
      bridge.text(2 * level), bridge.name(), level,
      [&](const Scene<2>& scene, const Motion& motion, Measurement& result) {
        for (const MeasureSource& m : scene.measures) {
          if (m.name == "below.contact_angle")
            result.errors.emplace_back("angle (degrees)", m.compute(motion) - bridge.below);
          if (m.name == "above.contact_angle")
            result.errors.emplace_back("other angle (degrees)", m.compute(motion) - bridge.above);
        }
      });
}

template <int D>
Measurement run_case(const Case& c, int level) {
  const int core = D == 3 ? level : 2 * level;
  return study::measure_scene<D>(
      c.text(core), c.name(), level,
      [&](const Scene<D>& scene, const Motion& motion, Measurement& result) {
        for (const MeasureSource& m : scene.measures) {
          if (m.name == "wall.contact_angle")
            result.errors.emplace_back("angle (degrees)", m.compute(motion) - c.angle);
          for (const char* value : {"wall.base_radius", "wall.line_speed", "drop.ca"})
            if (m.name == value) result.values.emplace_back(value, m.compute(motion));
        }
      });
}

std::vector<Case> cases(bool brief) {
  if (brief) return {{3, 90}, {2, 120}, {3, 120, 2}};
  std::vector<Case> all;
  for (const Real angle : {15.0, 30.0, 60.0, 90.0, 120.0, 150.0, 165.0}) {
    all.push_back({3, angle});
    all.push_back({2, angle});
  }
  for (const Real angle : {60.0, 90.0, 120.0}) {
    all.push_back({3, angle, 0.6, 150});
    all.push_back({3, angle, 2});
    all.push_back({3, angle, 10});
    all.push_back({3, angle, -3});
  }
  return all;
}

void run_bridges(StudyRun& study) {
  for (const Bridge& bridge : {Bridge{90, 60}, Bridge{120, 90}})
    for (const int level : study.levels()) {
      study.record(run_bridge(bridge, level));
      for (const auto& [what, error] : study.measurements().back().errors)
        study.require(fmt::format("{}, level {}: {}", bridge.name(), level, what), error,
                      {-0.5, 0.5});
    }
}

void run(StudyRun& study) {
  study.finish_settings();
  for (const Case& c : cases(study.brief()))
    for (const int level : study.levels()) {
      study.record(c.dimension == 3 ? run_case<3>(c, level) : run_case<2>(c, level));
      if (level < 10 && !study.brief()) continue;
      const Real allowed = c.angle < 30 || c.angle > 150 ? 1 : 0.5;
      study.require(fmt::format("{}, level {}: error of the angle", c.name(), level),
                    study.measurements().back().errors.front().second, {-allowed, allowed});
    }
  run_bridges(study);
}

const bool registered = register_entry(
    StudyEntry{"contact_angle",
               "drops at rest on walls, by the range and offset that the program chooses",
               "cells per edge of the core of the ball; twice as many in 2D",
               {4, 6, 10},
               {6},
               run});

}  // namespace
}  // namespace meniscus::contact_angle_study
