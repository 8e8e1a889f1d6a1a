// SPDX-License-Identifier: BSD-3-Clause
// Names of the output of a run: columns of its history and fields of its frames.
#pragma once
#include "io/history.hpp"
#include "scene/scene.hpp"

namespace meniscus {

/// Kinds of energy that the force terms store ("strain", "surface"), each once.
template <int D>
std::vector<std::string> stored_kinds(const Scene<D>& scene);

/// The measures that [output] or an expectation names.
template <int D>
std::vector<MeasureSource> chosen_measures(const Scene<D>& scene);

/// The columns of history.csv: time, step, dt, energies, errors, how far from
/// rest a relaxation is, and the chosen measures.
template <int D>
std::vector<HistoryColumn> history_columns(const Scene<D>& scene);

/// Throws InputError with every field, measure and column that [output] and [expect] name but the
/// scene does not have. (They are known only when the bodies and their force terms are built.)
template <int D>
void require_known_outputs(const SceneInput& input, const Scene<D>& scene);

}  // namespace meniscus
