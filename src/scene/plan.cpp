// SPDX-License-Identifier: BSD-3-Clause
// Reads a whole scene and makes all checks that need no particles.
#include "scene/plan.hpp"

#include "body/mesh/mesh_regions.hpp"
#include "body/shapes/cell_count.hpp"
#include "input/names.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "parallel/ranks.hpp"
#include "scene/key_reference.hpp"
#include "scene/resolved_places.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>

namespace meniscus {

template <int D>
const BodyPlan<D>* require_body(const Block& block, const BodyPlans<D>& bodies,
                                const std::string& name, std::string_view key) {
  std::vector<std::string> known;
  for (const BodyPlan<D>& body : bodies) {
    if (body.settings.name == name) return body.in_order ? &body : nullptr;
    known.push_back(body.settings.name);
  }
  if (block.has(key) && !known.empty())
    block.problem(key, fmt::format("there is no body '{}'; {}", name, allowed_names(name, known)));
  return nullptr;
}
template const BodyPlan<2>* require_body(const Block&, const BodyPlans<2>&, const std::string&,
                                         std::string_view);
template const BodyPlan<3>* require_body(const Block&, const BodyPlans<3>&, const std::string&,
                                         std::string_view);

void require_plain_name(const Block& block, const std::string& name) {
  if (block.has("name") && !is_plain_name(name))
    block.problem("name",
                  fmt::format("'{}' cannot be a name; allowed are letters, digits, _ and -", name));
}

namespace {

void require_components(const Block& block, const char* key, std::size_t given, int D) {
  if (given == static_cast<std::size_t>(D) || !block.has(key)) return;
  block.problem(key, fmt::format("has {} components; allowed are {}, one per dimension", given, D));
}

/// A table [body.material], read.
template <int D>
struct PlannedMaterial {
  std::unique_ptr<Material<D>> material;  ///< null: the table has a problem
  SolidSettings solid;
};

template <int D>
PlannedMaterial<D> read_material_table(const Block& block) {
  const auto type = block.kind("type", laws().names());
  if (!type) return {};
  PlannedMaterial<D> planned{laws().at(*type).template material<D>(block), {}};
  if (!laws().at(*type).viscous) planned.solid = read<SolidSettings>(block);
  block.done();
  return planned;
}

template <int D>
std::vector<std::string> region_names(const Geometry<D>& geometry) {
  const MeshRegions* regions = mesh_regions(geometry);
  return regions ? regions->names : std::vector<std::string>{};
}

/// The numbers of the regions that the tables [[body.material]] name, in the order of the tables;
/// empty if one of them is wrong.
template <int D>
std::vector<std::size_t> named_regions(const std::vector<Block>& blocks, const BodyPlan<D>& plan) {
  const std::vector<std::string> names = region_names(plan.geometry);
  std::vector<std::string> known;
  std::copy_if(names.begin(), names.end(), std::back_inserter(known),
               [](const std::string& name) { return !name.empty(); });
  std::vector<std::size_t> numbers;
  bool in_order = plan.in_order;
  for (const Block& block : blocks) {
    const std::string name = block.text("region", "");
    if (!plan.in_order || !block.has("region")) {
      in_order = false;
      continue;
    }
    const auto found = std::find(names.begin(), names.end(), name);
    const auto number = static_cast<std::size_t>(found - names.begin());
    std::string wrong;
    if (known.empty())
      wrong = fmt::format(
          "the body has no regions; allowed is this key for a mesh (.msh) with physical {}, or one "
          "[body.material] without it",
          D == 3 ? "volumes" : "surfaces");
    else if (found == names.end() || name.empty())
      wrong = fmt::format("the mesh has no region '{}'; {}", name, allowed_names(name, known));
    else if (std::find(numbers.begin(), numbers.end(), number) != numbers.end())
      wrong = fmt::format("region '{}' has a material already; allowed is one", name);
    if (!wrong.empty()) block.problem("region", wrong);
    in_order = in_order && wrong.empty();
    numbers.push_back(number);
  }
  return in_order ? numbers : std::vector<std::size_t>{};
}

/// Notes in the table of the body which regions have no material. Returns false if there is one.
bool require_all_regions(const Block& body, const std::vector<std::string>& names,
                         const std::vector<std::size_t>& given, int D) {
  std::vector<std::string> missing;
  for (std::size_t r = 0; r < names.size(); ++r)
    if (std::find(given.begin(), given.end(), r) == given.end()) missing.push_back(names[r]);
  if (missing.empty()) return true;
  if (std::find(missing.begin(), missing.end(), "") != missing.end())
    body.problem("material", fmt::format("the mesh has cells in no physical {}, which have no "
                                         "material; add them to one",
                                         D == 3 ? "volume" : "surface"));
  else
    body.problem("material",
                 fmt::format("region '{}' of the mesh has no material; give it a [[body.material]] "
                             "with region = \"{}\"",
                             missing.front(), missing.front()));
  return false;
}

/// Makes one material of those of the regions.
template <int D>
void join_regions(const Block& body, const std::vector<Block>& blocks,
                  std::vector<PlannedMaterial<D>> planned, BodyPlan<D>& plan) {
  const std::vector<std::size_t> numbers = named_regions(blocks, plan);
  const std::vector<std::string> names = region_names(plan.geometry);
  if (numbers.empty() || !require_all_regions(body, names, numbers, D)) return;
  if (plan.settings.integration != "q_scni")
    body.problem("integration",
                 fmt::format("'{}' has no nodal cells, which have the mean of the materials of "
                             "their regions; allowed is q_scni",
                             plan.settings.integration));
  std::vector<std::size_t> table(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) table[numbers[k]] = k;
  PlannedMaterial<D>& first = planned[table.front()];
  for (std::size_t r = 1; r < table.size(); ++r) {
    const PlannedMaterial<D>& next = planned[table[r]];
    if (!first.material || !next.material) return;
    const Block& block = blocks[table[r]];
    if (!first.material->add_region(*next.material))
      block.problem("type",
                    "regions of a body differ in the numbers of one law only; allowed is the same "
                    "mooney_rivlin, neo_hookean or st_venant_kirchhoff for all of them");
    if (next.solid.viscosity != first.solid.viscosity)
      block.problem("viscosity",
                    fmt::format("differs from that of region '{}'; allowed is the same "
                                "viscosity for all regions of a body",
                                names.front()));
  }
  plan.material = std::move(first.material);
  plan.solid = first.solid;
}

template <int D>
void plan_material(const Block& body, BodyPlan<D>& plan) {
  std::vector<Block> blocks;
  if (body.is_array("material"))
    blocks = body.tables("material");
  else if (const auto block = body.table("material", true))
    blocks = {*block};
  const bool by_region = blocks.size() > 1 || (blocks.size() == 1 && blocks.front().has("region"));
  if (by_region)
    for (const Block& block : blocks) block.text("region", std::nullopt);
  std::vector<PlannedMaterial<D>> planned;
  for (const Block& block : blocks) planned.push_back(read_material_table<D>(block));
  if (by_region) return join_regions(body, blocks, std::move(planned), plan);
  if (planned.empty() && body.is_array("material"))
    body.problem("material",
                 "has no table; allowed is [body.material], or a [[body.material]] for each "
                 "region of a mesh");
  if (planned.empty()) return;
  plan.material = std::move(planned.front().material);
  plan.solid = planned.front().solid;
}

template <int D>
void require_resolved_places(const Block& block, const Grid<D>& grid) {
  Real farthest = 0;
  for (const Vec<D>& X : grid.X) farthest = std::max(farthest, X.cwiseAbs().maxCoeff());
  const std::string lost = lost_in_rounding(farthest, shortest_edge(grid), block.units());
  if (!lost.empty()) block.problem(block.has("centre") ? "centre" : "shape", lost);
}

/// Reports what bodies of revolution do not have: on the axis a particle has no circle to stretch.
template <int D>
void require_revolvable(const Block& block, const BodyPlan<D>& body) {
  if (body.settings.integration == "nodal")
    block.problem("integration", "is 'nodal', for a body of revolution; allowed are q_scni, gauss");
}

template <int D>
void plan_bodies(const Block& root, BodyPlans<D>& bodies) {
  const auto blocks = root.tables("body");
  if (blocks.empty() && (!root.has("body") || root.in_order()))
    root.problem("body", "missing; a scene needs at least one [[body]]");
  std::set<std::string> names;
  for (const Block& block : blocks) {
    BodySettings settings = read<BodySettings>(block);
    settings.integration_place = block.place("integration");
    if (!settings.name.empty() && !names.insert(settings.name).second)
      block.problem("name", fmt::format("the name '{}' is used twice", settings.name));
    require_plain_name(block, settings.name);
    if (settings.volumetric == "cell_average" && settings.integration != "q_scni")
      block.problem("volumetric",
                    fmt::format("'cell_average' averages over nodal cells, which integration = "
                                "\"{}\" does not have; allowed are automatic, full",
                                settings.integration));
    if (root.has("initial") && block.has("initial_displacement"))
      block.problem("initial_displacement",
                    "has no meaning beside [initial], which has the first positions");
    require_components(block, "initial_displacement", settings.initial_displacement.size(), D);
    require_components(block, "initial_velocity", settings.initial_velocity.size(), D);
    Geometry<D> geometry = read_geometry<D>(block, root.is_text("dimension"));
    if (block.in_order()) require_resolved_places(block, geometry.grid);
    const bool in_order = block.in_order();
    bodies.push_back({std::move(settings), std::move(geometry), nullptr, in_order});
    plan_material(block, bodies.back());
    if (root.is_text("dimension")) require_revolvable(block, bodies.back());
    block.done();
  }
}

/// Reads all tables of one kind of load.
template <int D>
void plan_loads(const Block& root, const LoadEntry<D>& kind, std::set<std::string>& claims,
                Plan<D>& plan) {
  std::set<std::string> identities;
  for (const Block& block : root.tables(kind.name)) {
    std::unique_ptr<Load<D>> load = kind.read(block);
    load->check(block, plan.bodies);
    load->prepare(plan.bodies);
    const auto identity = load->identity();
    if (identity && !identity->value.empty() && !identities.insert(identity->value).second)
      block.problem(identity->key,
                    fmt::format("there is a [[{}]] with {} '{}' already; allowed is one per {}",
                                kind.name, identity->key, identity->value, identity->key));
    else if (const std::string claim = load->claim();
             !claim.empty() && !claims.insert(claim).second)
      block.problem("", fmt::format("{} has a law already; allowed is one", claim));
    block.done();
    plan.loads.push_back(std::move(load));
  }
}

/// Reads all loads in the order in which they are built.
template <int D>
void plan_loads(const Block& root, Plan<D>& plan) {
  std::set<std::string> claims;
  for (const Stage stage : {Stage::surface, Stage::volume, Stage::contact, Stage::measure})
    for (const auto& [name, kind] : loads<D>())
      if (kind.stage == stage) plan_loads(root, kind, claims, plan);
}

/// Names of all bodies and loads that may have measures.
template <int D>
std::vector<std::string> names_of(const Plan<D>& plan) {
  std::vector<std::string> names;
  for (const BodyPlan<D>& body : plan.bodies) names.push_back(body.settings.name);
  for (const auto& load : plan.loads)
    if (const auto identity = load->identity()) names.push_back(identity->value);
  return names;
}

/// True for solids in 3D. They reach a given error much sooner with narrower supports than drops
/// and curvature need, and with supports that do not grow at faces (performance note 3.1).
template <int D>
bool has_narrow_supports(const BodyPlan<D>& body) {
  return D == 3 && body.material && !body.material->fluid() && !body.curvature;
}

/// Kernel function and supports where the scene leaves them out. Round liquids in
/// 3D and of revolution have few neighbours with large weights (performance note 3.2). At edges,
/// moment matrices are poor with so few, and second derivatives of curvature, directors, and
/// tensions that pull along the surface are inaccurate. A director in 2D shears a liquid at its
/// surface, where supports that grow would double the error (cells note 6).
template <int D>
SupportDefaults default_supports(const BodyPlan<D>& body) {
  const bool director = body.material && body.material->carries_director(),
             in_space = space_dimension(body.geometry.grid) == 3,
             few = in_space && body.material && body.material->fluid() && !director &&
                   !body.curvature && !body.pulled_along && body.geometry.surface->smooth();
  return {few ? "triweight" : "cubic_spline", has_narrow_supports(body) ? 1.5 : 1.8,
          (D == 2 && director) || has_narrow_supports(body) ? "cells" : "neighbours"};
}

template <int D>
void settle_supports(const Block& root, BodyPlans<D>& bodies) {
  const auto blocks = root.tables("body");
  for (std::size_t k = 0; k < bodies.size(); ++k)
    bodies[k].settings.settle_support(blocks[k], default_supports(bodies[k]));
}

/// Expected memory of a body in bytes, during set-up and run, with integration "q_scni"; other
/// rules need more. The pairs of a row are estimated as the particles in a ball whose radius is the
/// support plus half the diagonal of a cell (within 10 % of counts for lattices and balls).
template <int D>
Real expected_bytes(const BodyPlan<D>& body) {
  const BodySettings& s = body.settings;
  const Real support =
      s.support_spacings > 0 ? s.support_spacings : *s.support_factor * std::sqrt(Real(D));
  const Real reach = support + 0.6;
  constexpr Real ball = (D == 3 ? 4.0 / 3 : 1.0) * std::numbers::pi;
  const Real pairs = ball * std::pow(reach, D);
  constexpr int gradients = D * (D + 1);  // mean gradients and linear moments
  constexpr Real bytes_per_pair = 8.0 * gradients + 4;
  constexpr Real rest = D == 3 ? 2e3 : 1e3;
  return Real(body.geometry.grid.node_count()) * (pairs * bytes_per_pair / ranks().size() + rest);
}

/// Reports bodies that together need more memory than there is, although each alone may fit.
template <int D>
void require_memory_for(const Block& root, const BodyPlans<D>& bodies) {
  const auto blocks = root.tables("body");
  Real bytes = 0, particles = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies[k].in_order) return;
    bytes += expected_bytes(bodies[k]);
    particles += bodies[k].geometry.grid.node_count();
    try {
      require_memory(bytes,
                     fmt::format("{} would have {:.4g} particles",
                                 k > 0 ? "the bodies up to this one" : "the body", particles));
    } catch (const InputError& error) {
      return blocks[k].problem("shape", error.what());
    }
  }
}

/// Reports expectations that can never be met.
void require_reachable(const Block& block, const ExpectSettings& e, Real end) {
  if (e.within_relative && !e.within && e.value.value_or(0) == 0)
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

/// Reports names of expectations that cannot be words of printed tables and columns of sweep.csv.
/// Dots are allowed, as in "drop.aspect".
void require_name_of_expectation(const Block& block, const std::string& name) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), plain))
    block.problem("", "cannot be a name; allowed are letters, digits, _, - and .");
}

RunSettings read_settings(const Block& root) {
  RunSettings run;
  run.title = root.text("title", "");
  run.units = root.units();
  Real end = unbounded;  // if the end time is missing or wrong
  if (root.has("stage"))
    root.problem("stage",
                 "the scene has stages, each of which is a scene; meniscus run and meniscus check "
                 "take them one after the other");
  if (const auto block = root.table("initial")) {
    run.initial = read<InitialSettings>(*block);
    run.initial.from_place = block->place("from");
    if (block->has("from") && run.initial.from.empty())
      block->problem("from", "is empty; allowed is the directory of a run");
    block->done();
  }
  const Block resolution = root.table_or_defaults("resolution");
  read<ResolutionSettings>(resolution);
  resolution.done();
  if (const auto block = root.table("time", true)) {
    run.time = read<TimeSettings>(*block);
    run.time.step_place = block->place("step");
    run.time.solver_place = block->place("solver");
    run.time.viscosity_place = block->place("viscosity");
    if (run.time.viscosity != "explicit" && run.time.solver != "dynamics")
      block->problem("viscosity", fmt::format("has no meaning for solver = \"{}\"; allowed is it "
                                              "with solver = \"dynamics\"",
                                              run.time.solver));
    if (block->in_order()) end = run.time.end;
    block->done();
  }
  const Block output = root.table_or_defaults("output");
  run.output = read<OutputSettings>(output);
  if (run.output.revolved && !root.is_text("dimension"))
    output.problem("revolved", "is for dimension = \"axisymmetric\"; allowed is false");
  output.done();
  if (const auto expect = root.table("expect"))
    for (const auto& [name, block] : expect->named_tables()) {
      require_name_of_expectation(block, name);
      ExpectSettings e = read<ExpectSettings>(block);
      if (e.of.empty()) e.of = name;
      require_reachable(block, e, end);
      block.done();
      run.expectations.emplace_back(name, std::move(e));
    }
  return run;
}

}  // namespace

int scene_dimension(const SceneInput& input) {
  if (input.root().is_text("dimension")) {
    input.root().choice("dimension", {"axisymmetric"}, std::nullopt);
    return 2;
  }
  const auto dimension = input.root().integer("dimension", {2, 3}, std::nullopt);
  if (dimension != 2 && dimension != 3) input.check();
  return static_cast<int>(dimension);
}

template <int D>
Plan<D> read_plan(const SceneInput& input) {
  Plan<D> plan{read_settings(input.root()), {}, {}};
  plan_bodies(input.root(), plan.bodies);
  plan_loads(input.root(), plan);
  settle_supports(input.root(), plan.bodies);
  require_memory_for(input.root(), plan.bodies);
  input.root().done();
  try {
    input.check();
  } catch (const InputError&) {
    note_unknown_measures(input.root(), plan, names_of(plan));
    input.check();
  }
  plan.complete = input.complete();
  return plan;
}

template Plan<2> read_plan(const SceneInput&);
template Plan<3> read_plan(const SceneInput&);

}  // namespace meniscus
