// SPDX-License-Identifier: BSD-3-Clause
// Curvature of exact surfaces from the deformation of a ball or a disk (RKPM note 3.1): bases,
// supports, windows, places, re-referencing, and what brings the order up.
#include "support/bodies.hpp"
#include "support/curvature_list.hpp"
#include "support/height_function.hpp"

#include <algorithm>

namespace meniscus {
namespace {

using namespace study;

struct Settings {
  Maps maps;
  bool one_map = false;
  Real jitter = 0;
};

template <int D>
std::vector<std::string> map_names() {
  std::vector<std::string> names;
  for (const NamedMap<D>& map : named_maps<D>()) names.push_back(map.name);
  return names;
}

/// Maps of one dimension by name; all of them without a name.
template <int D>
std::vector<NamedMap<D>> chosen_maps(const std::string& name) {
  std::vector<NamedMap<D>> maps;
  for (const NamedMap<D>& map : named_maps<D>())
    if (name.empty() || map.name == name) maps.push_back(map);
  return maps;
}

template <int D>
bool is_shape(const std::string& name) {
  const auto& known = reference_shapes<D>();
  return std::find(known.begin(), known.end(), name) != known.end();
}

Settings read_settings(const StudyRun& study) {
  const Block& block = study.settings();
  Settings settings;
  std::string shape, map;
  if (block.has("shape")) {
    std::vector<std::string> allowed = reference_shapes<3>();
    allowed.insert(allowed.end(), reference_shapes<2>().begin(), reference_shapes<2>().end());
    shape = block.choice("shape", allowed, {});
  }
  const auto is_file = [](const std::string& s) { return s.find(".toml") != std::string::npos; };
  if (block.has("map")) {
    map = block.text("map", {});
    std::vector<std::string> known = map_names<3>();
    for (const std::string& name : map_names<2>())
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
    if (!is_file(map)) map = block.choice("map", known, {});
  }
  settings.jitter = block.real("jitter", dimension::none, {0, 0.5, false, true}, 0.0);
  study.settings_read();

  if (is_shape<3>(shape)) require_curvature(shape, reference_body<3>(shape, 2));
  if (is_shape<2>(shape)) require_curvature(shape, reference_body<2>(shape, 2));
  settings.one_map = !map.empty();
  settings.maps =
      is_file(map) ? map_from_file(map) : Maps{chosen_maps<2>(map), chosen_maps<3>(map)};
  if (is_shape<3>(shape)) settings.maps.plane.clear();
  if (is_shape<2>(shape)) settings.maps.space.clear();
  return settings;
}

/// The maps onto the unit sphere and circle, for which height-function errors are published.
bool is_round(const std::string& map) {
  return map == "twist" || map == "swirl";
}

template <int D>
void add_height_function(Measurement& result) {
  const Real diameter = 2 / result.h;
  result.values.emplace_back("points per diameter", diameter);
  if (const auto published = height_function_error<D>(diameter)) {
    result.values.emplace_back("height function mean", published->mean);
    result.values.emplace_back("height function rms", published->rms);
    result.values.emplace_back("height function max", published->max);
  }
}

template <int D>
void measure(StudyRun& study, const NamedMap<D>& map, const std::vector<CurvatureMethod<D>>& list,
             Real jitter) {
  std::vector<CurvatureProblem<D>> problems;
  for (const int level : study.levels()) {
    Geometry<D> body = reference_body<D>(reference_shapes<D>()[0], level);
    if (jitter > 0) jitter_interior(body.grid, jitter, 1);
    problems.emplace_back(body, map);
  }
  for (const CurvatureMethod<D>& method : list)
    for (std::size_t i = 0; i < problems.size(); ++i) {
      Measurement result = problems[i].measure(method);
      result.level = study.levels()[i];
      if (is_round(map.name)) add_height_function<D>(result);
      study.record(std::move(result));
    }
}

template <int D>
void measure_all(StudyRun& study, const std::vector<NamedMap<D>>& maps, const Settings& settings) {
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (study.brief() && i > 0) break;
    const bool all = !study.brief() && (i == 0 || settings.one_map);
    measure(study, maps[i], all ? all_methods<D>() : main_methods<D>(study.brief()),
            settings.jitter);
  }
}

void run(StudyRun& study) {
  const Settings settings = read_settings(study);
  measure_all<3>(study, settings.maps.space, settings);
  measure_all<2>(study, settings.maps.plane, settings);
}

const bool registered =
    register_study({"curvature",
                    "curvature of exact surfaces from the deformation of a ball or disk",
                    "cells per edge of the core of the ball or disk",
                    {6, 10, 14, 20},
                    {4, 6, 8},
                    run});

}  // namespace
}  // namespace meniscus
