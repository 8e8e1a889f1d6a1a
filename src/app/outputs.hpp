// SPDX-License-Identifier: BSD-3-Clause
// Names in the output of a run: columns of the history and fields of the frames.
#pragma once
#include "io/history.hpp"
#include "scene/scene.hpp"

namespace meniscus {

/// The kinds of energy that the force terms store ("strain", "surface"), without repetitions.
template <int D>
std::vector<std::string> stored_kinds(const Scene<D>& scene);

/// The measures that [output] or an expectation names.
template <int D>
std::vector<MeasureSource> chosen_measures(const Scene<D>& scene);

/// The columns of history.csv: time, step, dt, energies, errors, the distance of a relaxation from
/// rest, and the chosen measures.
template <int D>
std::vector<HistoryColumn> history_columns(const Scene<D>& scene);

/// Throws InputError if [output] or [expect] names an unknown field, measure or column; the message
/// lists all of them. The check needs the built scene, since bodies and force terms define the
/// names.
template <int D>
void require_known_outputs(const SceneInput& input, const Scene<D>& scene);

}  // namespace meniscus
