// SPDX-License-Identifier: BSD-3-Clause
// Curvature of exact surfaces, from the deformation of a ball or a disk (RKPM note 3.1): bases,
// supports, kernels, places, updates of the reference, and means to raise the order.
#include "meniscus/error.hpp"
#include "study/support/bodies.hpp"
#include "study/support/curvature_list.hpp"
#include "study/support/height_function.hpp"

#include <algorithm>
#include <cmath>

namespace meniscus::curvature_study {
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

/// The map of that name in one dimension; all maps if the name is empty.
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
    for (const std::string& name : map_names<2>()) known.push_back(name);
    if (!is_file(map)) map = block.choice("map", known, {});
  }
  settings.jitter = block.real("jitter", dimension::none, {0, 0.5, false, true}, 0.0);
  study.finish_settings();

  if (is_shape<3>(shape)) require_curvature(shape, reference_body<3>(shape, 2));
  if (is_shape<2>(shape)) require_curvature(shape, reference_body<2>(shape, 2));
  settings.one_map = !map.empty();
  settings.maps =
      is_file(map) ? map_from_file(map) : Maps{chosen_maps<2>(map), chosen_maps<3>(map)};
  if (is_shape<3>(shape)) settings.maps.plane.clear();
  if (is_shape<2>(shape)) settings.maps.space.clear();
  if (settings.maps.space.empty() && settings.maps.plane.empty())
    throw InputError(fmt::format(
        "the map '{}' is not one of the {}; leave out one of map and shape", map, shape));
  return settings;
}

/// True for maps onto the unit sphere and circle. Errors of height functions are published for
/// these.
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
    const bool all = !study.brief() && i == 0 && (D == 3 || settings.one_map);
    measure(study, maps[i], all ? all_methods<D>() : main_methods<D>(study.brief()),
            settings.jitter);
  }
}

/// L2 errors at levels 6, 10, 14, 20 from RKPM note 3.1; 0 if there is none.
struct Noted {
  std::string method;
  std::array<Real, 4> L2;
};
const std::vector<Noted> noted{
    {"twist_ellipsoid, bases: linear 1.6 d_6, cubic_spline, points",
     {7.9e-2, 5.6e-2, 4.8e-2, 4.5e-2}},
    {"twist_ellipsoid, cubic_spline, points: quadratic 1.5 d_20, cubic_spline, points",
     {6.1e-2, 3.4e-2, 2.4e-2, 1.7e-2}},
    {"twist_ellipsoid, cubic_spline, points: quadratic 1.8 d_20, cubic_spline, points",
     {9.9e-3, 4.9e-3, 3.4e-3, 2.8e-3}},
    {"twist_ellipsoid, cubic_spline, points: quadratic 2.0 d_20, cubic_spline, points",
     {1.1e-2, 5.8e-3, 3.9e-3, 2.9e-3}},
    {"twist_ellipsoid, quintic_spline, points: quadratic 2.3 d_20, quintic_spline, points",
     {1.1e-2, 4.7e-3, 2.8e-3, 1.8e-3}},
    {"twist_ellipsoid, quintic_spline, nodes: quadratic 2.0 d_20, quintic_spline, nodes",
     {9.2e-3, 2.8e-3, 1.5e-3, 1.1e-3}},
    {"twist_ellipsoid, bases: cubic 1.75 d_26, cubic_spline, points", {3.2e-3, 7.2e-4, 4.0e-4, 0}},
    {"twist_ellipsoid, bases: cubic 2.0 d_26, cubic_spline, points", {2.8e-3, 7.7e-4, 3.2e-4, 0}},
    {"biconcave, methods: quadratic 1.5 d_20, cubic_spline, points",
     {1.5e-1, 9.2e-2, 6.6e-2, 4.7e-2}},
    {"biconcave, methods: quadratic 2.0 d_20, cubic_spline, points",
     {3.0e-2, 1.4e-2, 9.7e-3, 7.5e-3}},
    {"biconcave, methods: cubic 1.75 d_26, cubic_spline, points", {2.6e-2, 4.3e-3, 2.6e-3, 0}}};

void require_noted(StudyRun& study) {
  constexpr std::array<int, 4> levels{6, 10, 14, 20};
  for (const Noted& n : noted)
    for (std::size_t i = 0; i < levels.size(); ++i)
      if (const Measurement* m = study.find(n.method, levels[i]); m != nullptr && n.L2[i] > 0)
        study.require(
            fmt::format("L2 over that of RKPM note 3.1, {}, {} particles", n.method, m->particles),
            m->error("L2") / n.L2[i], {0.8, 1.2});
}

/// Targets for quadratic and cubic bases on the twisted ellipsoid, and orders.
void require_targets(StudyRun& study) {
  const std::string map = "twist_ellipsoid, ", in_short = map + "methods: ";
  const std::string line = "quadratic 1.8 d_20, cubic_spline, points",
                    cubic = "cubic 2.0 d_26, cubic_spline, points";
  const auto limit = [&](const std::string& method, const char* error, Real most) {
    if (const Measurement* m = study.find(method, 10))
      study.require(fmt::format("{}, {}, 4341 particles", error, method), m->error(error),
                    {0, most});
  };
  limit(map + "cubic_spline, points: " + line, "L2", 6e-3);
  limit(map + "cubic_spline, points: " + line, "max", 2.5e-2);
  limit(map + "bases: " + cubic, "L2", 9e-4);
  limit(map + "recovered: " + line + ", recovered", "L2", 2e-3);
  // The order of the quadratic basis is lower between close levels and between fine levels.
  if (study.levels().front() > 6 || study.levels().back() < 2 * study.levels().front()) return;
  const auto order = [&](const std::string& method, Real least) {
    const Real found = study.overall_order(method, "L2");
    if (!std::isnan(found)) study.require("order of L2, " + method, found, {least, unbounded});
  };
  order(map + "cubic_spline, points: " + line, 1);
  order(map + "bases: " + cubic, 2.3);
  order(map + "recovered: " + line + ", recovered", 2.4);
  order(map + "recovered: " + cubic + ", recovered", 3);
  order(in_short + line, 1.5);
  order(in_short + cubic, 2.3);
  order(in_short + line + ", recovered", 2.4);
}

/// Notes, for every method on the sphere and the circle, its errors relative to height functions.
void compare_height_functions(StudyRun& study) {
  std::vector<std::string> done;
  for (const Measurement& first : study.measurements()) {
    if (first.values.size() < 2 || std::count(done.begin(), done.end(), first.method)) continue;
    done.push_back(first.method);
    std::string text =
        first.method + ", errors over those of height functions, by points per diameter:";
    bool below = true, published = false;
    for (const Measurement& m : study.measurements()) {
      if (m.method != first.method || m.values.size() < 4) continue;
      published = true;
      text += fmt::format(" [{:.0f}]", m.values[0].second);
      const std::array<const char*, 3> errors{"mean", "rms", "max"};
      for (std::size_t k = 0; k < errors.size(); ++k) {
        const Real ratio = m.error(errors[k]) / m.values[k + 1].second;
        text += fmt::format(" {} {:.2f}{}", errors[k], ratio, k < 2 ? "," : ";");
        below = below && ratio < 1;
      }
    }
    if (published) study.note(text + (below ? " all below." : " NOT all below."));
  }
}

void run(StudyRun& study) {
  const Settings settings = read_settings(study);
  measure_all<3>(study, settings.maps.space, settings);
  measure_all<2>(study, settings.maps.plane, settings);
  compare_height_functions(study);
  if (settings.jitter > 0) return;
  require_noted(study);
  require_targets(study);
}

const bool registered =
    register_entry(StudyEntry{"curvature",
                              "curvature of exact surfaces from the deformation of a ball or disk; "
                              "--set map=NAME or FILE.toml, shape=NAME, jitter=NUMBER",
                              "cells per edge of the core of the ball or disk",
                              {6, 10, 14, 20},
                              {4, 6, 8},
                              run});

}  // namespace
}  // namespace meniscus::curvature_study
