// SPDX-License-Identifier: BSD-3-Clause
// Checks that the columns and fields requested by a scene exist.
#include "app/outputs.hpp"

#include "input/names.hpp"
#include "meniscus/error.hpp"
#include "meniscus/solve/stepper.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

using Names = std::vector<std::string>;

bool contains(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Names of the fields of the motion and of all bodies.
template <int D>
Names known_fields(const Scene<D>& scene) {
  Names names{"displacement", "velocity", "force"};
  for (const BodyField& field : scene.fields)
    if (!contains(names, field.source.name)) names.push_back(field.source.name);
  return names;
}

void require_known(const Block& block, const char* key, const Names& given, const Names& known) {
  for (const std::string& name : given)
    if (!contains(known, name))
      block.problem(key, fmt::format("'{}' is unknown; {}", name, allowed_names(name, known)));
}

/// Reports numbers of an expectation whose unit does not fit the unit of the column.
void require_unit_of_column(const Block& block, const std::string& name,
                            const std::vector<HistoryColumn>& columns) {
  const auto column = std::find_if(columns.begin(), columns.end(),
                                   [&](const HistoryColumn& c) { return c.name == name; });
  if (column == columns.end()) return;
  for (const char* key : {"value", "within", "level"}) {
    const auto dimension = block.own_dimension(key);
    if (!dimension) continue;
    try {
      block.units().quantity("1 " + column->unit, *dimension);
    } catch (const InputError&) {
      block.problem(
          key, fmt::format("is in {}; the column '{}' is in {}", block.units().symbol(*dimension),
                           name, column->unit == "1" ? "plain numbers" : column->unit));
    }
  }
}

}  // namespace

template <int D>
Names stored_kinds(const Scene<D>& scene) {
  Names kinds;
  for (const auto& term : scene.system.terms) {
    const std::string kind(term->energy_kind());
    if (!kind.empty() && !contains(kinds, kind)) kinds.push_back(kind);
  }
  return kinds;
}

template <int D>
std::vector<MeasureSource> chosen_measures(const Scene<D>& scene) {
  Names names = scene.output.measures;
  for (const auto& entry : scene.expectations) names.push_back(entry.second.of);
  std::vector<MeasureSource> chosen;
  for (const MeasureSource& m : scene.measures)
    if (contains(names, m.name)) chosen.push_back(m);
  return chosen;
}

template <int D>
std::vector<HistoryColumn> history_columns(const Scene<D>& scene) {
  const auto unit = [&](Dimension d) { return scene.units.symbol(d); };
  const std::string energy = scene.symbol_of_sum(dimension::energy);
  std::vector<HistoryColumn> columns{{"time", unit(dimension::time)},
                                     {"step", "1"},
                                     {"dt", unit(dimension::time)},
                                     {"kinetic_energy", energy}};
  for (const std::string& kind : stored_kinds(scene)) columns.push_back({kind + "_energy", energy});
  columns.push_back({"dissipated", energy});
  columns.push_back({"external_work", energy});
  if (!scene.remaps.empty()) {
    columns.push_back({"remapped", energy});
    columns.push_back({"remaps", "1"});
  }
  columns.push_back({"energy_balance", energy});
  for (const char* name : {"energy_balance_error", "momentum_error", "angular_momentum_error"})
    columns.push_back({name, "1"});
  for (const std::string& name : Registry<StepperEntry>::all().at(scene.time.solver).residuals)
    columns.push_back({name, "1"});
  for (const MeasureSource& m : chosen_measures(scene))
    columns.push_back({m.name, unit(m.dimension)});
  return columns;
}

template <int D>
void require_known_outputs(const SceneInput& input, const Scene<D>& scene) {
  Names measures, columns;
  for (const MeasureSource& m : scene.measures) measures.push_back(m.name);
  const std::vector<HistoryColumn> all_columns = history_columns(scene);
  for (const HistoryColumn& column : all_columns) columns.push_back(column.name);
  for (const std::string& measure : measures)
    if (!contains(columns, measure)) columns.push_back(measure);

  if (const auto output = input.root().table("output")) {
    require_known(*output, "fields", scene.output.fields, known_fields(scene));
    require_known(*output, "measures", scene.output.measures, measures);
    for (const std::string& field : scene.output.fields)
      if (std::count(scene.output.fields.begin(), scene.output.fields.end(), field) > 1)
        output->problem("fields", fmt::format("'{}' is named twice", field));
  }
  if (const auto expect = input.root().table("expect"))
    for (const auto& [name, e] : scene.expectations) {
      const auto block = expect->table(name);
      require_known(*block, block->has("of") ? "of" : "", {e.of}, columns);
      require_unit_of_column(*block, e.of, all_columns);
    }
  input.check();
}

template Names stored_kinds(const Scene<2>&);
template Names stored_kinds(const Scene<3>&);
template std::vector<MeasureSource> chosen_measures(const Scene<2>&);
template std::vector<MeasureSource> chosen_measures(const Scene<3>&);
template std::vector<HistoryColumn> history_columns(const Scene<2>&);
template std::vector<HistoryColumn> history_columns(const Scene<3>&);
template void require_known_outputs(const SceneInput&, const Scene<2>&);
template void require_known_outputs(const SceneInput&, const Scene<3>&);

}  // namespace meniscus
