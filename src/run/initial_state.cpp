// SPDX-License-Identifier: BSD-3-Clause
// Reads the first state of a run from the last state of another one.
#include "run/initial_state.hpp"

#include "body/grid/ordering.hpp"
#include "input/text.hpp"
#include "io/checkpoint.hpp"
#include "meniscus/error.hpp"
#include "meniscus/solve/stepper.hpp"
#include "parallel/ranks.hpp"
#include "physics/continued_term.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

namespace meniscus {
namespace {

/// True if a key of a scene changes the meaning of the values of a saved state: the particles,
/// their shape functions and the units.
bool is_of_state(const std::string& key) {
  if (key.starts_with("units") || key == "dimension") return true;
  if (!key.starts_with("body")) return false;
  for (const char* other :
       {".material", ".initial_", ".integration", ".gauss_points", ".volumetric"})
    if (key.find(other) != std::string::npos) return false;
  return true;
}

/// True if the solver of a scene moves bodies in time, and does not seek a state of rest.
bool moves(const std::string& complete) {
  const SceneInput input = SceneInput::from_text(complete);
  const std::string solver = input.root().table_or_defaults("time").text("solver", "dynamics");
  const auto& all = Registry<StepperEntry>::all();
  return !all.find(solver) || all.at(solver).residuals.empty();
}

/// The groups of a saved state in which a term of this name has saved its values.
std::set<std::string> groups_of_term(const Snapshot& state, const std::string& name) {
  std::set<std::string> groups;
  const std::string sought = " " + name + "/";
  for (const auto& [array, values] : state.arrays())
    if (const std::size_t found = array.find(sought);
        array.starts_with("terms/") && found != array.npos)
      groups.insert(array.substr(0, found + sought.size() - 1));
  return groups;
}

/// Reads positions, velocities and other unknowns. Bodies with an initial velocity keep it.
template <int D>
void take_over(const Plan<D>& plan, const InitialState& initial, Scene<D>& scene) {
  const Archive a = Archive::reading(initial.state);
  archive_orders(scene.system, a.in("orders"));
  State& state = scene.initial;
  a("displacement", state.u, D, dimension::length);
  NodalVectors v = state.v;
  a("velocity", v, D, dimension::velocity);
  for (std::size_t b = 0; b < plan.bodies.size(); ++b) {
    if (!initial.moves || !plan.bodies[b].settings.initial_velocity.empty()) continue;
    const Body<D>& body = scene.system.bodies[b];
    std::copy_n(v.begin() + body.first, body.size(), state.v.begin() + body.first);
  }
  for (const auto& term : scene.system.terms)
    if (auto* const continued = dynamic_cast<ContinuedTerm*>(term.get()))
      for (const std::string& group : groups_of_term(initial.state, term->name()))
        continued->continue_from(a.in(group));
  for (Unknown& field : state.fields) {
    const Archive part = a.in("fields").in(field.spec.name);
    if (!a.in("fields").has(field.spec.name)) continue;
    part("value", field.x, field.spec.components, field.spec.dimension);
    if (initial.moves && field.spec.evolution == Evolution::inertial)
      part("rate", field.rate, field.spec.components);
  }
}

}  // namespace

template <int D>
std::optional<InitialState> read_initial_state(const Plan<D>& plan) {
  const InitialSettings& settings = plan.initial;
  if (settings.from.empty()) return std::nullopt;
  std::optional<ReadCheckpoint> from;
  on_each_rank([&] { from = read_checkpoint(settings.from); });
  require_alike(fmt::format("{:016x}", from->checkpoint.state.hash()),
                fmt::format("state of '{}'", from->file.string()));
  std::vector<std::string> keys = differing_keys(from->checkpoint.input, plan.complete);
  std::erase_if(keys, [](const std::string& key) { return !is_of_state(key); });
  if (!keys.empty())
    throw InputError(fmt::format(
        "{}: '{}' has the state of other bodies: {} differ{}; allowed is a run whose bodies differ "
        "in material, integration, gauss_points and volumetric only, and in what they begin with",
        settings.from_place, from->file.string(), joined(keys, ", "), keys.size() == 1 ? "s" : ""));
  InitialState initial{std::move(from->checkpoint.state), moves(from->checkpoint.input), ""};
  initial.note = fmt::format("the first state is that of {}, t = {:.9g} {}{}", from->file.string(),
                             from->checkpoint.time, plan.units.symbol(dimension::time),
                             initial.moves ? "" : ", at rest");
  return initial;
}

template <int D>
References<D> read_references(const Plan<D>& plan, const Snapshot& state) {
  References<D> references;
  const Archive all = Archive::reading(state).in("references");
  for (const BodyPlan<D>& body : plan.bodies) {
    const std::string& name = body.settings.name;
    if (!all.has(name)) continue;
    Geometry<D> geometry = body.geometry;
    order_spatially(geometry);
    Reference<D> reference = Reference<D>::of_scene(std::move(geometry), 0);
    const auto impossible = [&](const std::string& why) {
      throw FileError(fmt::format("the saved reference of body '{}' is impossible: {}", name, why));
    };
    try {
      reference.archive(all.in(name));
    } catch (const InputError& cause) {
      impossible(cause.what());
    }
    const auto& ratio = reference.volume_ratio;
    if (!(reference.mass > 0)) impossible("a mass that is not positive");
    if (!std::all_of(ratio.begin(), ratio.end(), [](Real J) { return J > 0; }))
      impossible("a volume ratio that is not positive");
    references[name] = std::make_shared<const Reference<D>>(std::move(reference));
  }
  return references;
}

template <int D>
Scene<D> build_from(const Plan<D>& plan, const std::optional<InitialState>& initial) {
  if (!initial) return build(plan);
  Scene<D> scene = build(plan, read_references(plan, initial->state));
  take_over(plan, *initial, scene);
  scene.notes.push_back(initial->note);
  return scene;
}

template <int D>
void archive_orders(const System<D>& system, const Archive& a) {
  constexpr Real of_rounding = 1e-6;  // in spacings, for all particles together
  for (const Body<D>& body : system.bodies) {
    if (body.reference) continue;
    const Vec<D> mark = mark_of_order<D>(body.geometry.grid.X);
    Eigen::Vector3d saved = Eigen::Vector3d::Zero();
    saved.head<D>() = mark;
    a(body.name, saved, dimension::length);
    if (!((saved.head<D>() - mark).norm() < of_rounding * mean_spacing(body.geometry.grid)))
      throw FileError(
          fmt::format("the saved state of body '{}' has its particles in another order: it was "
                      "written by another version; continue it with that one, or run it again",
                      body.name));
  }
}

#define MENISCUS_INSTANTIATE(D)                                                     \
  template std::optional<InitialState> read_initial_state(const Plan<D>&);          \
  template References<D> read_references(const Plan<D>&, const Snapshot&);          \
  template Scene<D> build_from(const Plan<D>&, const std::optional<InitialState>&); \
  template void archive_orders(const System<D>&, const Archive&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
