// SPDX-License-Identifier: BSD-3-Clause
// What a run writes: rows of the history, frames, checkpoints, and when.
#pragma once
#include "meniscus/app/simulation.hpp"
#include "meniscus/io/checkpoint.hpp"
#include "meniscus/io/history.hpp"
#include "meniscus/io/result_file.hpp"

namespace meniscus {

template <int D>
class Recorder {
 public:
  /// `continued`: the run goes on in the directory it was in before.
  Recorder(Simulation<D>& simulation, const RunDirectory& directory, const Provenance& provenance,
           bool continued);

  /// Writes what is due after a step that began at `before` (also the initial state, before = -1, and
  /// the last one). Returns the ledger if a row of the history was written.
  std::optional<Ledger> record(Real before, Real end);
  std::filesystem::path checkpoint();
  /// The places of the moment a run failed, without its state, which is not complete.
  void write_failed_frame();

 private:
  void write_row(const Ledger& ledger);
  void write_frame(bool with_state);
  std::vector<MeasureSource> chosen_measures() const;

  Simulation<D>& simulation_;
  std::vector<MeasureSource> measures_;
  std::vector<std::string> energy_kinds_;
  Real history_every_, frames_every_;
  ResultFile results_;
  HistoryWriter history_;
  CheckpointWriter checkpoints_;
};

}  // namespace meniscus
