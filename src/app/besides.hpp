// SPDX-License-Identifier: BSD-3-Clause
// Scenes with slightly other numbers, which follow the equilibria of a run (--beside).
#pragma once
#include "app/commands.hpp"
#include "io/history.hpp"
#include "io/run_directory.hpp"
#include "run/epochs.hpp"

#include <memory>
#include <vector>

namespace meniscus {

/// The scenes of --beside, and their files beside-1.csv, beside-2.csv, ...: a row with the stored
/// energies and measures of each scene for each row of the history. Differences of two of them are
/// derivatives of the equilibria by the numbers of the scene.
template <int D>
class Besides {
 public:
  /// Reads and builds the scenes. Throws InputError for a wrong one, or if bodies are remapped.
  explicit Besides(const RunRequest& request);

  /// Begins the files, on rank 0.
  void open(const RunDirectory& directory);
  /// Moves each scene to its equilibrium near the one of the run, and writes a row. Throws like
  /// Simulation::follow().
  void record(Simulation<D>& run);

 private:
  std::vector<std::unique_ptr<Epochs<D>>> scenes_;
  std::vector<HistoryWriter> files_;
};

}  // namespace meniscus
