// SPDX-License-Identifier: BSD-3-Clause
// Reading a scene whole, with every check that needs no particles: one short block per kind of
// table.
#include "plan.hpp"

#include "meniscus/body/shapes.hpp"
#include "meniscus/body/wall_supports.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/names.hpp"
#include "meniscus/physics/law_registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace meniscus {

template <int D>
const typename Plan<D>::PlannedBody* Plan<D>::require(const Block& block, const std::string& name,
                                                      const char* key) const {
  std::vector<std::string> known;
  for (const PlannedBody& body : bodies) {
    if (body.settings.name == name) return &body;
    known.push_back(body.settings.name);
  }
  if (block.has(key) && !known.empty())
    block.problem(key, fmt::format("there is no body '{}'; {}", name, allowed_names(name, known)));
  return nullptr;
}

namespace {

void require_components(const Block& block, const char* key, std::size_t given, int D) {
  if (given == static_cast<std::size_t>(D) || !block.has(key)) return;
  block.problem(key, fmt::format("has {} components; allowed are {}, one per dimension", given, D));
}

/// The name of a body is part of names in run.h5 and history.csv.
void require_plain_name(const Block& block, const std::string& name) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (block.has("name") && (name.empty() || !std::all_of(name.begin(), name.end(), plain)))
    block.problem("name",
                  fmt::format("'{}' cannot be a name; allowed are letters, digits, _ and -", name));
}

template <int D>
std::unique_ptr<Material<D>> plan_material(const Block& body) {
  const auto block = body.table("material", true);
  if (!block) return nullptr;
  std::vector<std::string> names;
  for (const auto& [name, law] : laws()) names.emplace_back(name);
  const auto type = block->kind("type", names);
  if (!type) return nullptr;
  auto material = laws().find(*type)->second.template material<D>(*block);
  block->done();
  return material;
}

template <int D>
void plan_bodies(const Block& root, Plan<D>& plan) {
  const auto blocks = root.tables("body");
  if (blocks.empty()) root.problem("body", "a scene needs at least one [[body]]");
  std::set<std::string> names;
  for (const Block& block : blocks) {
    BodySettings settings = read<BodySettings>(block);
    if (!settings.name.empty() && !names.insert(settings.name).second)
      block.problem("name", fmt::format("the name '{}' is used twice", settings.name));
    require_plain_name(block, settings.name);
    if (settings.volumetric == "cell_average" && settings.integration != "q_scni")
      block.problem("volumetric",
                    fmt::format("'cell_average' averages over nodal cells, which integration = "
                                "\"{}\" does not have; allowed are automatic, full",
                                settings.integration));
    require_components(block, "initial_displacement", settings.initial_displacement.size(), D);
    require_components(block, "initial_velocity", settings.initial_velocity.size(), D);
    Geometry<D> geometry = read_geometry<D>(block);
    auto material = plan_material<D>(block);
    block.done();
    plan.bodies.push_back({std::move(settings), std::move(geometry), std::move(material), false});
  }
}

/// The measures of a table that a body may have once only would have equal names.
template <class Settings>
void require_first(const Block& block, const std::vector<Settings>& all) {
  const auto same = [&](const Settings& s) { return s.body == all.back().body; };
  if (block.has("body") && std::count_if(all.begin(), all.end(), same) > 1)
    block.problem("body", fmt::format("'{}' has such a table already; allowed is one per body",
                                      all.back().body));
}

template <int D>
void plan_cavities(const Block& root, Plan<D>& plan) {
  for (const Block& block : root.tables("cavity")) {
    plan.cavities.push_back(read<CavitySettings>(block));
    const CavitySettings& cavity = plan.cavities.back();
    const auto* body = plan.require(block, cavity.body);
    require_first(block, plan.cavities);
    if (body && cavity.surface == "inner" && !is_hollow(body->geometry))
      block.problem("surface", fmt::format("'{}' has no inner surface; allowed is outer",
                                           body->settings.name));
    if (cavity.pressure && cavity.volume_target)
      block.problem("pressure", "the volume is given, too; allowed is one of them");
    if (cavity.volume_target.has_value() != cavity.penalty.has_value())
      block.problem("penalty", "goes with volume_target; allowed are both or neither");
    block.done();
  }
  for (const Block& block : root.tables("profile")) {
    plan.profiles.push_back(read<ProfileSettings>(block));
    const ProfileSettings& profile = plan.profiles.back();
    const auto* body = plan.require(block, profile.body);
    require_first(block, plan.profiles);
    if (body && !is_hollow(body->geometry))
      block.problem("body", fmt::format("'{}' is not a shell", body->settings.name));
    if (profile.r.size() != profile.z.size() || profile.r.empty())
      block.problem("z",
                    fmt::format("has {} numbers, but r has {}; allowed are as many, at least 1",
                                profile.z.size(), profile.r.size()));
    block.done();
  }
}

template <int D>
void plan_loads(const Block& root, Plan<D>& plan) {
  for (const Block& block : root.tables("surface_tension")) {
    plan.tensions.push_back(read<TensionSettings>(block));
    const auto* body = plan.require(block, plan.tensions.back().body);
    require_first(block, plan.tensions);
    if (body && plan.tensions.back().form == "curvature" && !body->geometry.smooth)
      block.problem("form", fmt::format("the surface of '{}' has edges, where the curvature is "
                                        "undefined; allowed are balanced, weak, triangles",
                                        body->settings.name));
    if (plan.tensions.back().form == "balanced")
      for (auto& planned : plan.bodies)
        planned.enclosed |= &planned == body && planned.material && planned.material->fluid();
    block.done();
  }
  for (const Block& block : root.tables("body_force")) {
    plan.body_forces.push_back(read<BodyForceSettings>(block));
    plan.require(block, plan.body_forces.back().body);
    require_components(block, "acceleration", plan.body_forces.back().acceleration.size(), D);
    block.done();
  }
  plan_cavities(root, plan);
  for (const Block& block : root.tables("exact")) {
    plan.exact.push_back(read<ExactSettings>(block));
    plan.require(block, plan.exact.back().body);
    require_first(block, plan.exact);
    require_components(block, "displacement", plan.exact.back().displacement.size(), D);
    require_components(block, "velocity", plan.exact.back().velocity.size(), D);
    block.done();
  }
}

/// What can never be met, or is always, is a mistake.
void require_reachable(const Block& block, const ExpectSettings& e, Real end) {
  if (!e.within && !e.within_relative)
    block.problem("", "says no tolerance; give within or within_relative");
  if (e.within_relative && !e.within && e.value == 0)
    block.problem("within_relative", "nothing is within a fraction of 0; give within");
  for (const auto& [key, time] : {std::pair("at", e.at), std::pair("to", e.to)})
    if (time > end) block.problem(key, fmt::format("is after the end; allowed is <= {:.9g}", end));
  if (e.from >= e.to.value_or(end))
    block.problem("from",
                  fmt::format("the span is empty; allowed is < {:.9g}", e.to.value_or(end)));
  for (const char* key : {"from", "to"})
    if (e.reduce == "at" && block.has(key))
      block.problem(key, "has no meaning for reduce = \"at\"; allowed is at");
  if (e.reduce != "at" && e.at)
    block.problem(
        "at", fmt::format("has no meaning for reduce = \"{}\"; allowed are from, to", e.reduce));
  if ((e.reduce == "falls") != e.level.has_value())
    block.problem("level", e.level ? "has a meaning for reduce = \"falls\" only"
                                   : "is missing; reduce = \"falls\" counts falls below it");
}

template <int D>
void read_settings(const SceneInput& input, Scene<D>& scene) {
  const Block& root = input.root();
  scene.title = root.text("title", "");
  scene.units = root.units();
  if (const auto block = root.table("time", true)) {
    scene.time = read<TimeSettings>(*block);
    scene.time.step_place = block->place("step");
    block->done();
  }
  const Block output = root.table_or_defaults("output");
  scene.output = read<OutputSettings>(output);
  output.done();
  if (const auto expect = root.table("expect"))
    for (const auto& [name, block] : expect->named_tables()) {
      ExpectSettings e = read<ExpectSettings>(block);
      if (e.of.empty()) e.of = name;
      require_reachable(block, e, scene.time.end);
      block.done();
      scene.expectations.emplace_back(name, std::move(e));
    }
}

}  // namespace

template <int D>
Plan<D> read_plan(const SceneInput& input, Scene<D>& scene) {
  Plan<D> plan;
  read_settings(input, scene);
  plan_bodies(input.root(), plan);
  plan_loads(input.root(), plan);
  plan_contacts(input.root(), plan);
  input.root().done();
  input.check();
  return plan;
}

template Plan<2> read_plan(const SceneInput&, Scene<2>&);
template Plan<3> read_plan(const SceneInput&, Scene<3>&);

}  // namespace meniscus
