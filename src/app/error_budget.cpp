// SPDX-License-Identifier: BSD-3-Clause
// Runs of a scene with other values of the parameters whose limit is meant.
#include "app/error_budget.hpp"

#include "meniscus/physics/law_registry.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace meniscus {
namespace {

/// A key of a scene and its number, in units of the scene.
struct Parameter {
  std::string key;
  Real value;
};

/// The number of a key; empty if it is absent or a formula.
void take(std::vector<Parameter>& all, const Block& block, const char* key, Dimension dimension) {
  if (!block.has(key)) return;
  const Real value = block.real(key, dimension, range::positive, 0.0);
  if (value > 0) all.push_back({fmt::format("{}.{}", block.path(), key), value});
}

/// The material of a body; empty if it is not a fluid, or has several regions.
std::optional<Block> fluid_of(const Block& body) {
  const auto material = body.is_array("material") ? std::nullopt : body.table("material");
  const auto type = material ? material->kind("type", laws().names()) : std::nullopt;
  return type && laws().at(*type).viscous ? material : std::nullopt;
}

/// Between solids the range is a property of the material.
std::vector<Parameter> ranges_of(const Block& root) {
  std::set<std::string> fluids;
  for (const Block& body : root.tables("body"))
    if (fluid_of(body)) fluids.insert(body.text("name", ""));
  std::vector<Parameter> all;
  for (const Block& contact : root.tables("contact")) {
    const std::vector<std::string> bodies = contact.texts("bodies", std::vector<std::string>{});
    if (std::any_of(bodies.begin(), bodies.end(),
                    [&](const auto& b) { return fluids.contains(b); }))
      take(all, contact, "range", dimension::length);
  }
  return all;
}

std::vector<Parameter> bulk_moduli_of(const Block& root) {
  std::vector<Parameter> all;
  for (const Block& body : root.tables("body"))
    if (const auto fluid = fluid_of(body)) take(all, *fluid, "bulk_modulus", dimension::pressure);
  return all;
}

bool is_solved_by(const Block& root, const std::string& solver) {
  const auto time = root.table("time");
  return time && time->text("solver", "dynamics") == solver;
}

std::vector<Parameter> step_of(const Block& root) {
  if (!is_solved_by(root, "dynamics")) return {};
  const auto time = root.table("time");
  std::vector<Parameter> all;
  take(all, *time, "step", dimension::time);
  if (all.empty()) all.push_back({"time.safety", time->real("safety", {}, range::positive, 0.9)});
  return all;
}

/// At which relax ends.
std::vector<Parameter> tolerances_of(const Block& root) {
  if (!is_solved_by(root, "relax")) return {};
  const auto time = root.table("time");
  return {{"time.force_tolerance", time->real("force_tolerance", {}, range::positive, 1e-5)},
          {"time.shape_tolerance", time->real("shape_tolerance", {}, range::positive, 1e-4)}};
}

/// Runs with 1, q and q^2 times the values of the scene. `h` of a run is `times` to this power.
ModelError varied(const std::string& name, const std::vector<Parameter>& parameters, Real q,
                  int power) {
  ModelError error{name, {}, {{}}, {1}, false};
  for (const Parameter& p : parameters) error.keys.push_back(p.key);
  for (const Real times : {q, q * q}) {
    error.values.emplace_back();
    for (const Parameter& p : parameters)
      error.values.back().push_back(fmt::format("{:.9g}", p.value * times));
    error.h.push_back(std::pow(times, power));
  }
  error.scene_is_first = error.h[1] < 1;
  if (!error.scene_is_first) {
    std::swap(error.values.front(), error.values.back());
    std::swap(error.h.front(), error.h.back());
  }
  return error;
}

}  // namespace

std::vector<ModelError> model_errors(const SceneInput& input) {
  constexpr Real factor = 1.5, of_tolerances = 0.25;
  const Block& root = input.root();
  std::vector<ModelError> all;
  if (const auto ranges = ranges_of(root); !ranges.empty())
    all.push_back(varied("range", ranges, factor, 1));
  if (const auto moduli = bulk_moduli_of(root); !moduli.empty())
    all.push_back(varied("compressibility", moduli, 1 / factor, -1));
  if (const auto step = step_of(root); !step.empty())
    all.push_back(varied("step", step, 1 / factor, 1));
  if (const auto tolerances = tolerances_of(root); !tolerances.empty())
    all.push_back(varied("equilibrium", tolerances, of_tolerances, 1));
  return all;
}

}  // namespace meniscus
