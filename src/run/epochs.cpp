// SPDX-License-Identifier: BSD-3-Clause
// Leads a run from one epoch to the next by a remap.
#include "run/epochs.hpp"

#include "body/grid/ordering.hpp"
#include "meniscus/error.hpp"
#include "meniscus/scene/assembly.hpp"
#include "run/initial_state.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace meniscus {
namespace {

template <int D>
std::size_t number_of(const System<D>& system, const std::string& body) {
  std::size_t b = 0;
  while (system.bodies[b].name != body) ++b;
  return b;
}

/// Number of steps between two checks of the distortion of bodies: 50, doubled each time the number
/// of steps doubles beyond 800. So a remap that is refused again and again costs little.
std::int64_t steps_between_looks(std::int64_t step) {
  std::int64_t between = 50;
  while (16 * between <= step / 2) between *= 2;
  return between;
}

/// J - 1 of the nodal cells of a body.
template <int D>
std::vector<Real> volume_changes(const Scene<D>& scene, std::size_t body, const Motion& motion) {
  for (const BodyField& field : scene.fields)
    if (field.body == body && field.source.name == "J") {
      std::vector<Real> J(static_cast<std::size_t>(scene.system.bodies[body].size()));
      field.source.compute(motion, J);
      for (Real& x : J) x -= 1;
      return J;
    }
  throw InputError("body '" + scene.system.bodies[body].name + "' has no field J");
}

/// Largest energy change by a remap without a warning, as a fraction of the energy exchanged so
/// far. A remap interpolates; one that changes the energy more has changed the motion.
constexpr Real bearable_change = 0.01;

/// Warns of a remap that changes the energy of a run.
template <int D>
std::optional<std::string> doubt_of_remap(const Simulation<D>& after, const Ledger& before,
                                          Real exchanged) {
  const Real changed = after.state().books.remapped - before.remapped;
  if (!(exchanged > 0) || std::abs(changed) <= bearable_change * exchanged) return std::nullopt;
  const Scene<D>& scene = after.scene();
  const Real kinetic = take_ledger(scene.system, after.state()).kinetic;
  return fmt::format(
      "changes the energy by {:.3g} {}, which is {:.3g} % of the {:.3g} exchanged so far (kinetic "
      "energy {:.3g} before, {:.3g} after): what follows is another motion; remap earlier (a lower "
      "condition of [[remap]]), use finer particles, or keep the particles with nodes = "
      "\"particles\"",
      changed, scene.symbol_of_sum(dimension::energy), 100 * std::abs(changed) / exchanged,
      exchanged, before.kinetic, kinetic);
}

/// True if the bodies have moved enough since the last remap for another one. At rest, remaps
/// would go on for ever: each displaces the surface a little from rest, and its way back stretches
/// the cells again (wetting note 9).
template <int D>
bool moves(const System<D>& system, const State& state) {
  constexpr Real least_ratio = 10;
  const Books& books = state.books;
  return books.dissipated - books.dissipated_at_remap + take_ledger(system, state).kinetic >=
         least_ratio * std::abs(books.last_remap);
}

}  // namespace

template <int D>
Epochs<D>::Epochs(Plan<D> plan, const Snapshot* state) : plan_(std::move(plan)) {
  begin(state ? build(plan_, read_references(plan_, *state))
              : build_from(plan_, read_initial_state(plan_)));
  if (state) simulation_->restore(*state);
}

template <int D>
void Epochs<D>::begin(Scene<D> built) {
  auto scene = std::make_unique<Scene<D>>(std::move(built));
  auto simulation = std::make_unique<Simulation<D>>(*scene);
  simulation_ = std::move(simulation);
  scene_ = std::move(scene);
}

template <int D>
void Epochs<D>::restore(const Snapshot& state) {
  const References<D> references = read_references(plan_, state);
  const bool in_first = std::all_of(scene_->system.bodies.begin(), scene_->system.bodies.end(),
                                    [](const Body<D>& body) { return !body.reference; });
  if (!in_first || !references.empty()) begin(build(plan_, references));
  simulation_->restore(state);
}

template <int D>
void Epochs<D>::add(std::unique_ptr<const Load<D>> load) {
  auto& terms = scene_->system.terms;
  const std::size_t terms_before = terms.size();
  Assembly<D> assembly(*scene_, false);
  try {
    load->build(assembly);
    auto simulation = std::make_unique<Simulation<D>>(*scene_);
    simulation->begin_with_new_terms(simulation_->snapshot());
    simulation_ = std::move(simulation);
  } catch (...) {
    terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(terms_before), terms.end());
    throw;
  }
  plan_.loads.push_back(std::move(load));
}

template <int D>
void Epochs<D>::new_epoch(const Nodes& nodes) {
  const System<D>& system = scene_->system;
  const State& state = simulation_->state();
  References<D> references;
  std::map<std::string, Remap<D>> remaps;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Body<D>& body = system.bodies[b];
    if (body.reference) references[body.name] = body.reference;
    const auto found = nodes.find(body.name);
    if (found == nodes.end()) continue;
    require_remappable(*scene_, body.name);
    Remap<D> next = remap<D>(body, state.u.data() + body.first, found->second,
                             volume_changes(*scene_, b, state.motion()));
    references[body.name] = next.reference;
    remaps.emplace(body.name, std::move(next));
  }
  auto scene = std::make_unique<Scene<D>>(build(plan_, references));
  auto simulation = std::make_unique<Simulation<D>>(*scene);
  simulation->begin_after(*simulation_, carried(system, state, scene->system, remaps));
  simulation_ = std::move(simulation);
  scene_ = std::move(scene);
}

template <int D>
bool Epochs<D>::due(const PlannedRemap& planned, Real before, Remapped& result) {
  const State& state = simulation_->state();
  const bool at_a_time = std::any_of(planned.times.begin(), planned.times.end(),
                                     [&](Real t) { return before < t && t <= state.time; });
  const bool looks = planned.condition > 0 && state.step % steps_between_looks(state.step) == 0;
  if (at_a_time || looks) simulation_->complete_state();
  if (at_a_time || !looks || !(planned.now(state.motion()) > planned.condition)) return at_a_time;
  if (moves(scene_->system, state)) return true;
  if (!said_rest_)
    result.notes.push_back(
        fmt::format("t = {:.6g}: body '{}' keeps its reference at rest: kinetic energy, and heat "
                    "since the last "
                    "remap, are less than ten times the energy that it changed",
                    state.time, planned.body));
  said_rest_ = true;
  return false;
}

template <int D>
Seeds<D> Epochs<D>::seeds(const PlannedRemap& planned, std::size_t b) const {
  const State& state = simulation_->state();
  const Body<D>& body = scene_->system.bodies[b];
  const NodalVector* u = state.u.data() + body.first;
  if (!planned.even && !body.geometry.surface->smooth()) return on_present_patches<D>(body, u);
  if (!planned.even) return present_nodes<D>(body, u, volume_changes(*scene_, b, state.motion()));
  Geometry<D> ideal = plan_.bodies[b].geometry;
  order_spatially(ideal);
  std::optional<ContactLine<D>> line;
  const auto on_body = [&](const Wetting<D>& wetting) { return wetting.body == planned.body; };
  const auto& all = scene_->wetting;
  if (std::count_if(all.begin(), all.end(), on_body) == 1)
    line = std::find_if(all.begin(), all.end(), on_body)->line;
  return reseeded(body, u, ideal.grid, line, state.time);
}

template <int D>
typename Epochs<D>::Remapped Epochs<D>::advance() {
  const Real before = simulation_->state().time;
  simulation_->advance();
  Remapped result;
  const Real now = simulation_->state().time;
  for (const PlannedRemap& planned : std::vector<PlannedRemap>(scene_->remaps)) {
    if (!due(planned, before, result)) continue;
    const State& state = simulation_->state();
    const std::size_t b = number_of(scene_->system, planned.body);
    const std::string what = fmt::format("t = {:.6g}: body '{}'", now, planned.body);
    const Ledger ledger = take_ledger(scene_->system, state);
    Audit audit = simulation_->audit();
    audit.follow(scene_->system, state, ledger);
    const auto refuse = [&](const std::exception& cause) {
      result.warnings.push_back(fmt::format("{} keeps its reference: {}", what, cause.what()));
    };
    try {
      new_epoch({{planned.body, seeds(planned, b)}});
      result.new_epoch = true;
      said_rest_ = false;
      result.notes.push_back(fmt::format(
          "{} is remapped, epoch {}: the energy changes by {:.3g} {}", what,
          simulation_->state().epoch, simulation_->state().books.remapped - ledger.remapped,
          scene_->symbol_of_sum(dimension::energy)));
      if (const auto doubt = doubt_of_remap(*simulation_, ledger, audit.energy_scale))
        result.warnings.push_back(fmt::format("{}: the remap {}", what, *doubt));
    } catch (const InputError& cause) {
      refuse(cause);
    } catch (const SolveError& cause) {
      refuse(cause);
    }
  }
  return result;
}

template class Epochs<2>;
template class Epochs<3>;

}  // namespace meniscus
