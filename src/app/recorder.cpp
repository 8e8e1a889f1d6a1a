// SPDX-License-Identifier: BSD-3-Clause
// Writes the history, the frames and the checkpoints of a run.
#include "app/recorder.hpp"

#include "app/outputs.hpp"
#include "body/grid/simplex.hpp"
#include "body/particle_values.hpp"
#include "parallel/ranks.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

template <int D>
ResultOptions result_options(const Simulation<D>& simulation, bool continued) {
  const OutputSettings& output = simulation.scene().output;
  ResultOptions options;
  options.precision = output.precision == "float32" ? ResultOptions::Precision::float32
                                                    : ResultOptions::Precision::float64;
  options.compression = output.compression;
  options.time_unit = simulation.scene().units.symbol(dimension::time);
  options.epoch = simulation.state().epoch;
  if (continued) options.continue_after = simulation.state().step;
  return options;
}

/// Constant arrays of a body in the result file, with the memory they refer to.
template <int D>
struct ReferenceArrays {
  std::vector<Real> X, volume, support, mass;
  std::vector<Index> cells, facets;

  explicit ReferenceArrays(const Body<D>& body) : mass(body.mass) {
    for (Index A = 0; A < body.size(); ++A) {
      for (int i = 0; i < D; ++i) X.push_back(at(body.particles.X(), A)[i]);
      volume.push_back(body.cells.volume(A));
      support.push_back(at(body.particles.support(), A));
    }
    // VTK numbers the corners of a cell around the lower face, then around the upper one; the grid
    // numbers them in tensor order.
    for (const auto& cell : body.geometry.grid.cells)
      if (is_simplex<D>(cell))
        for (const int a : simplex_corners<D>()) cells.push_back(at(cell, a));
      else
        for (int a = 0; a < Grid<D>::corners; ++a) cells.push_back(at(cell, a ^ ((a >> 1) & 1)));
    for (const auto& facet : body.geometry.grid.facets)
      facets.insert(facets.end(), facet.nodes.begin(), facet.nodes.end());
  }
};

template <int D>
std::unique_ptr<ResultFile> make_result_file(const Simulation<D>& simulation,
                                             const RunDirectory& directory,
                                             const Provenance& provenance, bool continued) {
  const Scene<D>& scene = simulation.scene();
  const auto unit = [&](Dimension d) { return scene.units.symbol(d); };
  std::deque<ReferenceArrays<D>> arrays;
  std::vector<BodyReference> bodies;
  for (const Body<D>& body : scene.system.bodies) {
    const ReferenceArrays<D>& a = arrays.emplace_back(body);
    const bool simplices = is_simplex<D>(body.geometry.grid.cells.front());
    bodies.push_back({body.name,
                      {{"X", D, unit(dimension::length), a.X},
                       {"volume", 1, scene.symbol_of_sum(dimension::volume), a.volume},
                       {"support", 1, unit(dimension::length), a.support},
                       {"mass", 1, scene.symbol_of_sum(dimension::mass), a.mass}},
                      simplices ? D + 1 : Grid<D>::corners,
                      a.cells,
                      a.facets,
                      simplices});
  }
  return std::make_unique<ResultFile>(directory, provenance, bodies,
                                      result_options(simulation, continued));
}

/// Values at the particles: sum_B N_B(X_A) f_B for each particle A, D numbers per particle.
template <int D>
std::vector<Real> at_places(const System<D>& system, const NodalVectors& field) {
  std::vector<Real> values(field.size() * D);
  for (const Body<D>& body : system.bodies) {
    const NodalVectors x = values_at_particles(body, field.data() + body.first);
    for (Index A = 0; A < body.size(); ++A)
      for (int i = 0; i < D; ++i) at(values, (body.first + A) * D + i) = at(x, A)[i];
  }
  return values;
}

template <int D>
std::vector<Real> positions(const System<D>& system, const State& state) {
  std::vector<Real> x = at_places(system, state.u);
  for (const Body<D>& body : system.bodies)
    for (Index A = 0; A < body.size(); ++A)
      for (int i = 0; i < D; ++i) at(x, (body.first + A) * D + i) += at(body.particles.X(), A)[i];
  return x;
}

/// One history file for each line of points.
template <int D>
std::vector<HistoryWriter> line_writers(const Scene<D>& scene, const RunDirectory& directory,
                                        std::optional<Real> continue_after) {
  std::vector<HistoryWriter> writers;
  for (const ProbedLine& line : scene.lines) {
    std::vector<HistoryColumn> columns{{"time", scene.units.symbol(dimension::time)}};
    for (const ProbedLine::Column& column : line.columns)
      columns.push_back({column.name, scene.units.symbol(column.dimension)});
    writers.emplace_back(directory.probe_file(line.name), std::move(columns), continue_after);
  }
  return writers;
}

}  // namespace

template <int D>
Recorder<D>::Recorder(Simulation<D>& simulation, const RunDirectory& directory,
                      const Provenance& provenance, bool continued)
    : simulation_(&simulation),
      directory_(directory),
      provenance_(provenance),
      measures_(chosen_measures(simulation.scene())),
      energy_kinds_(stored_kinds(simulation.scene())) {
  on_first_rank([&] { files_.emplace(simulation, directory, provenance, continued); });
}

template <int D>
Recorder<D>::Files::Files(const Simulation<D>& simulation, const RunDirectory& directory,
                          const Provenance& provenance, bool continued)
    : checkpoints(directory, provenance),
      history(directory.history_file(), history_columns(simulation.scene()),
              continued ? std::optional(simulation.state().time) : std::nullopt),
      lines(line_writers(simulation.scene(), directory,
                         continued ? std::optional(simulation.state().time) : std::nullopt)),
      results(make_result_file(simulation, directory, provenance, continued)),
      partners(simulation, directory, provenance, continued),
      revolved(simulation, directory, provenance, continued) {}

template <int D>
void Recorder<D>::begin_epoch(Simulation<D>& simulation) {
  simulation_ = &simulation;
  measures_ = chosen_measures(simulation.scene());
  on_first_rank([&] {
    files_->results.reset();  // closes the old file first
    files_->results = make_result_file(simulation, directory_, provenance_, false);
  });
  write_frame(simulation.scene().output.restartable);
}

template <int D>
std::optional<Ledger> Recorder<D>::record(Real before) {
  const OutputSettings& output = simulation_->scene().output;
  const Real now = simulation_->state().time, end = simulation_->scene().time.end;
  const bool last = simulation_->finished();
  std::optional<Ledger> ledger;
  if (last || output.record_due(before, now, end)) {
    ledger = simulation_->audit_now();
    write_row(*ledger);
  }
  if (last_frame_ != simulation_->state().step && (last || output.frame_due(before, now, end))) {
    write_frame(output.restartable);
    write_lines();
  }
  return ledger;
}

template <int D>
void Recorder<D>::write_row(const Ledger& ledger) {
  const State& state = simulation_->state();
  const Audit& audit = simulation_->audit();
  std::vector<Real> row{state.time, static_cast<Real>(state.step), simulation_->last_step(),
                        ledger.kinetic};
  for (const std::string& kind : energy_kinds_) row.push_back(ledger.stored.at(kind));
  row.push_back(ledger.dissipated);
  row.push_back(ledger.external_work);
  if (!simulation_->scene().remaps.empty()) {
    row.push_back(ledger.remapped);
    row.push_back(static_cast<Real>(state.epoch));
  }
  for (const Real x : {ledger.balance(), audit.balance_error(ledger), audit.momentum_error(ledger),
                       audit.angular_momentum_error(ledger)})
    row.push_back(x);
  for (const Residual& residual : simulation_->stepper().residuals(state))
    row.push_back(residual.value);
  for (const MeasureSource& m : measures_) row.push_back(m.compute(state.motion()));
  on_first_rank([&] { files_->history.write(row); });
}

template <int D>
void Recorder<D>::write_lines() {
  const State& state = simulation_->state();
  const auto& lines = simulation_->scene().lines;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto points = lines[k].compute(state.motion());
    on_first_rank([&] {
      for (const std::vector<Real>& point : points) {
        std::vector<Real> row{state.time};
        row.insert(row.end(), point.begin(), point.end());
        files_->lines[k].write(row);
      }
    });
  }
}

template <int D>
void Recorder<D>::write_frame(bool with_state) {
  simulation_->complete_state();
  const Scene<D>& scene = simulation_->scene();
  const State& state = simulation_->state();
  std::deque<std::vector<Real>> storage;
  std::vector<ResultField> fields;
  const auto add = [&](const std::string& name, int components, std::string unit,
                       std::vector<Real> values) {
    fields.push_back({name, components, std::move(unit), storage.emplace_back(std::move(values))});
  };
  const auto add_source = [&](const std::string& name) {
    const FieldSource& source = field_named(scene, name);
    add(name, source.components, scene.units.symbol(source.dimension),
        field_values(scene, name, state.motion()));
  };
  add("position", D, scene.units.symbol(dimension::length), positions(scene.system, state));
  for (const std::string& name : scene.output.fields) {
    if (name == "displacement")
      add(name, D, scene.units.symbol(dimension::length), at_places(scene.system, state.u));
    else if (name == "velocity")
      add(name, D, scene.units.symbol(dimension::velocity), at_places(scene.system, state.v));
    else if (name == "force")
      add(name, D, scene.symbol_of_sum(dimension::force), packed<D>(state.force));
    else
      add_source(name);
  }
  std::optional<Snapshot> snapshot;
  if (with_state) snapshot = simulation_->snapshot_of_first_rank();
  on_first_rank([&] {
    files_->results->write_frame(state.step, state.time, fields, snapshot ? &*snapshot : nullptr);
    files_->partners.write(state.step, state.time);
    files_->revolved.write(state.step, state.time, fields);
  });
  last_frame_ = state.step;
}

template <int D>
void Recorder<D>::checkpoint() {
  const Snapshot snapshot = simulation_->snapshot_of_first_rank();
  on_first_rank([&] {
    files_->checkpoints.write(simulation_->state().step, simulation_->state().time, snapshot);
  });
}

template <int D>
void Recorder<D>::write_last_good_frame() {
  if (last_frame_ != simulation_->state().step) write_frame(false);
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace meniscus
