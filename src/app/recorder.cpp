// SPDX-License-Identifier: BSD-3-Clause
// Rows, frames and checkpoints of a run.
#include "meniscus/app/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "meniscus/approx/row_sums.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

template <int D>
std::vector<std::string> stored_kinds(const Scene<D>& scene) {
  std::vector<std::string> kinds;
  for (const auto& term : scene.system.terms) {
    const std::string kind(term->energy_kind());
    if (!kind.empty() && std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
      kinds.push_back(kind);
  }
  return kinds;
}

template <int D>
std::vector<HistoryColumn> history_columns(const Scene<D>& scene,
                                           const std::vector<MeasureSource>& measures) {
  const auto unit = [&](Dimension d) { return scene.units.symbol(d); };
  const std::string energy = unit(dimension::energy);
  std::vector<HistoryColumn> columns{{"time", unit(dimension::time)},
                                     {"step", "1"},
                                     {"dt", unit(dimension::time)},
                                     {"kinetic_energy", energy}};
  for (const std::string& kind : stored_kinds(scene)) columns.push_back({kind + "_energy", energy});
  for (const char* name : {"dissipated", "external_work", "energy_balance"})
    columns.push_back({name, energy});
  for (const char* name :
       {"energy_balance_error", "momentum_error", "angular_momentum_error"})
    columns.push_back({name, "1"});
  for (const MeasureSource& m : measures) columns.push_back({m.name, unit(m.dimension)});
  return columns;
}

template <int D>
ResultOptions result_options(const Simulation<D>& simulation, bool continued) {
  const OutputSettings& output = simulation.scene().output;
  ResultOptions options;
  options.precision = output.precision == "float32" ? ResultOptions::Precision::float32
                                                    : ResultOptions::Precision::float64;
  options.compression = output.compression;
  options.time_unit = simulation.scene().units.symbol(dimension::time);
  if (continued) options.continue_after = simulation.state().step;
  return options;
}

/// Arrays of a body that do not change, and the storage behind them.
template <int D>
struct ReferenceArrays {
  std::vector<Real> X, volume, support, mass;
  std::vector<Index> facets;

  explicit ReferenceArrays(const Body<D>& body) : mass(body.mass) {
    for (Index A = 0; A < body.size(); ++A) {
      for (int i = 0; i < D; ++i) X.push_back(at(body.particles.X(), A)[i]);
      volume.push_back(body.cells.volume(A));
      support.push_back(at(body.particles.support(), A));
    }
    for (const auto& facet : body.geometry.grid.facets)
      facets.insert(facets.end(), facet.nodes.begin(), facet.nodes.end());
  }
};

template <int D>
ResultFile make_result_file(const Simulation<D>& simulation, const RunDirectory& directory,
                            const Provenance& provenance, bool continued) {
  const Scene<D>& scene = simulation.scene();
  const auto unit = [&](Dimension d) { return scene.units.symbol(d); };
  std::deque<ReferenceArrays<D>> arrays;
  std::vector<BodyReference> bodies;
  for (const Body<D>& body : scene.system.bodies) {
    const ReferenceArrays<D>& a = arrays.emplace_back(body);
    bodies.push_back(
        {body.name,
         {{"X", D, unit(dimension::length), a.X},
          {"volume", 1, unit(D == 3 ? dimension::volume : dimension::area), a.volume},
          {"support", 1, unit(dimension::length), a.support},
          {"mass", 1, unit(dimension::mass), a.mass}},
         {{"surface", 1 << (D - 1), a.facets}}});
  }
  return {directory, provenance, bodies, result_options(simulation, continued)};
}

/// sum_B N_B(X_A) f_B for all particles, D numbers each.
template <int D>
std::vector<Real> at_places(const System<D>& system, const NodalVectors& field) {
  std::vector<Real> values(field.size() * D);
  for (const Body<D>& body : system.bodies)
    parallel_for(body.size(), [&](Index A) {
      const Lanes x = value_at(body.at_particles, A, field.data() + body.first);
      for (int i = 0; i < D; ++i) at(values, (body.first + A) * D + i) = x[i];
    });
  return values;
}

/// Whether a multiple of `every` lies in (before, now].
bool due(Real before, Real now, Real every) {
  const auto count = [every](Real t) { return std::floor(t / every + 1e-9); };
  return count(now) > count(before);
}

}  // namespace

template <int D>
Recorder<D>::Recorder(Simulation<D>& simulation, const RunDirectory& directory,
                      const Provenance& provenance, bool continued)
    : simulation_(simulation),
      measures_(chosen_measures()),
      energy_kinds_(stored_kinds(simulation.scene())),
      history_every_(simulation.scene().output.history_every),
      frames_every_(simulation.scene().output.frames_every),
      results_(make_result_file(simulation, directory, provenance, continued)),
      history_(directory.history_file(), history_columns(simulation.scene(), measures_),
               continued ? std::optional(simulation.state().time) : std::nullopt),
      checkpoints_(directory, provenance) {
  const Real end = simulation.scene().time.end;
  if (history_every_ <= 0) history_every_ = end / 200;
  if (frames_every_ <= 0) frames_every_ = end / 50;
}

template <int D>
std::vector<MeasureSource> Recorder<D>::chosen_measures() const {
  const Scene<D>& scene = simulation_.scene();
  std::vector<std::string> names = scene.output.measures;
  for (const auto& entry : scene.expectations) names.push_back(entry.second.of);
  std::vector<MeasureSource> chosen;
  for (const MeasureSource& m : scene.measures)
    if (std::find(names.begin(), names.end(), m.name) != names.end()) chosen.push_back(m);
  return chosen;
}

template <int D>
std::optional<Ledger> Recorder<D>::record(Real before, Real end) {
  const Real now = simulation_.state().time;
  const bool last = now >= end;
  std::optional<Ledger> ledger;
  if (last || due(before, now, history_every_)) {
    ledger = simulation_.audit_now();
    write_row(*ledger);
  }
  if (last || due(before, now, frames_every_))
    write_frame(simulation_.scene().output.restartable);
  return ledger;
}

template <int D>
void Recorder<D>::write_row(const Ledger& ledger) {
  const State& state = simulation_.state();
  const Audit& audit = simulation_.audit();
  std::vector<Real> row{state.time, static_cast<Real>(state.step), simulation_.last_step(),
                        ledger.kinetic};
  for (const std::string& kind : energy_kinds_) row.push_back(ledger.stored.at(kind));
  for (const Real x : {ledger.dissipated, ledger.external_work, ledger.balance(),
                       audit.balance_error(ledger), audit.momentum_error(ledger),
                       audit.angular_momentum_error(ledger)})
    row.push_back(x);
  for (const MeasureSource& m : measures_) row.push_back(m.compute(state.motion()));
  history_.write(row);
}

template <int D>
void Recorder<D>::write_frame(bool with_state) {
  const Scene<D>& scene = simulation_.scene();
  const State& state = simulation_.state();
  const auto unit = [&](Dimension d) { return scene.units.symbol(d); };
  std::deque<std::vector<Real>> storage;
  std::vector<Field> fields;
  const auto add = [&](std::string name, int components, Dimension d, std::vector<Real> values) {
    fields.push_back({std::move(name), components, unit(d), storage.emplace_back(std::move(values))});
  };

  std::vector<Real> position = at_places(scene.system, state.u);
  const std::vector<Real> displacement = position;
  for (const Body<D>& body : scene.system.bodies)
    for (Index A = 0; A < body.size(); ++A)
      for (int i = 0; i < D; ++i)
        at(position, (body.first + A) * D + i) += at(body.particles.X(), A)[i];
  add("position", D, dimension::length, std::move(position));

  for (const std::string& name : scene.output.fields) {
    if (name == "displacement") {
      add(name, D, dimension::length, displacement);
    } else if (name == "velocity") {
      add(name, D, dimension::velocity, at_places(scene.system, state.v));
    } else if (name == "force") {
      std::vector<Real> force;
      for (const Lanes& f : state.force)
        for (int i = 0; i < D; ++i) force.push_back(f[i]);
      add(name, D, dimension::force, std::move(force));
    } else {
      std::vector<Real> values;
      int components = 1;
      Dimension d;
      for (std::size_t b = 0; b < scene.fields.size(); ++b)
        for (const FieldSource& source : scene.fields[b])
          if (source.name == name) {
            components = source.components;
            d = source.dimension;
            std::vector<Real> part(static_cast<std::size_t>(scene.system.bodies[b].size() * components));
            source.compute(state.motion(), part);
            values.insert(values.end(), part.begin(), part.end());
          }
      add(name, components, d, std::move(values));
    }
  }
  if (with_state) {
    const Snapshot snapshot = simulation_.snapshot();
    results_.write_frame(state.step, state.time, fields, &snapshot);
  } else {
    results_.write_frame(state.step, state.time, fields);
  }
}

template <int D>
std::filesystem::path Recorder<D>::checkpoint() {
  return checkpoints_.write(simulation_.state().step, simulation_.state().time,
                            simulation_.snapshot());
}

template <int D>
void Recorder<D>::write_failed_frame() {
  write_frame(false);
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace meniscus
