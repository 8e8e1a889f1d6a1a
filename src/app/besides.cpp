// SPDX-License-Identifier: BSD-3-Clause
// Builds the scenes of --beside and records them.
#include "app/besides.hpp"

#include "app/outputs.hpp"
#include "app/set_up.hpp"
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"

#include <fmt/core.h>

#include <sstream>

namespace meniscus {
namespace {

/// The parts of "KEY=VALUE; KEY=VALUE".
std::vector<std::string> settings_of(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream all(text);
  for (std::string part; std::getline(all, part, ';');) {
    const std::size_t begin = part.find_first_not_of(' ');
    if (begin != part.npos) parts.push_back(part.substr(begin));
  }
  return parts;
}

template <int D>
std::vector<HistoryColumn> columns_beside(const Scene<D>& scene) {
  std::vector<HistoryColumn> columns{{"time", scene.units.symbol(dimension::time)}};
  for (const std::string& kind : stored_kinds(scene))
    columns.push_back({kind + "_energy", scene.symbol_of_sum(dimension::energy)});
  for (const MeasureSource& m : chosen_measures(scene))
    columns.push_back({m.name, scene.units.symbol(m.dimension)});
  return columns;
}

}  // namespace

template <int D>
Besides<D>::Besides(const RunRequest& request) {
  for (const std::string& text : request.beside) {
    std::vector<std::string> settings = request.set;
    for (std::string& setting : settings_of(text)) settings.push_back(std::move(setting));
    const SceneInput input = SceneInput::from_file(request.scene, settings);
    if (scene_dimension(input) != D)
      throw InputError("--beside changes 'dimension'; allowed are changes of numbers");
    scenes_.push_back(
        set_up(input, [&] { return std::make_unique<Epochs<D>>(read_plan<D>(input)); }));
    if (!scenes_.back()->scene().remaps.empty())
      throw InputError("--beside is for scenes without [[remap]]; leave one of both out");
    set_up(input, [&] { scenes_.back()->simulation().begin(); });
  }
}

template <int D>
void Besides<D>::open(const RunDirectory& directory) {
  on_first_rank([&] {
    for (std::size_t k = 0; k < scenes_.size(); ++k)
      files_.emplace_back(directory.path() / fmt::format("beside-{}.csv", k + 1),
                          columns_beside(scenes_[k]->scene()));
  });
}

template <int D>
void Besides<D>::record(Simulation<D>& run) {
  for (std::size_t k = 0; k < scenes_.size(); ++k) {
    Simulation<D>& beside = scenes_[k]->simulation();
    beside.follow(run);
    const State& state = beside.state();
    const Scene<D>& scene = beside.scene();
    std::vector<Real> row{state.time};
    const Ledger ledger = take_ledger(scene.system, state);
    for (const std::string& kind : stored_kinds(scene)) row.push_back(ledger.stored.at(kind));
    for (const MeasureSource& m : chosen_measures(scene)) row.push_back(m.compute(state.motion()));
    on_first_rank([&] { files_[k].write(row); });
  }
}

template class Besides<2>;
template class Besides<3>;

}  // namespace meniscus
