// SPDX-License-Identifier: BSD-3-Clause
// Output of a run: rows of the history, frames and checkpoints, and the times at which they are
// due.
#pragma once
#include "app/partner_frames.hpp"
#include "app/revolved_frames.hpp"
#include "io/checkpoint.hpp"
#include "io/history.hpp"
#include "io/result_file.hpp"
#include "run/simulation.hpp"

namespace meniscus {

/// Writes the output that is due after each step of a run. All ranks compute the output; rank 0
/// holds the files.
template <int D>
class Recorder {
 public:
  /// `continued`: the run continues in the directory of an earlier run. Rows and frames later than
  /// the present state are deleted, since the run will write them again.
  Recorder(Simulation<D>& simulation, const RunDirectory& directory, const Provenance& provenance,
           bool continued);

  /// Continues with another simulation of the same scene, whose bodies have new reference
  /// configurations. Begins a new result file with a frame.
  void begin_epoch(Simulation<D>& simulation);
  /// Writes the row and the frame that are due after a step that began at time `before` (-1: for
  /// the initial state), or because the end of the scene is reached. Returns the ledger if a row
  /// was written.
  std::optional<Ledger> record(Real before);
  void checkpoint();
  /// Call this after a failed step. Writes the frame before that step if it was not written yet.
  /// The frame has no state for a restart, because the state is incomplete.
  void write_last_good_frame();

 private:
  void write_row(const Ledger& ledger);
  void write_lines();
  void write_frame(bool with_state);

  Simulation<D>* simulation_;
  const RunDirectory& directory_;
  Provenance provenance_;
  std::vector<MeasureSource> measures_;
  std::vector<std::string> energy_kinds_;
  struct Files {
    Files(const Simulation<D>& simulation, const RunDirectory& directory,
          const Provenance& provenance, bool continued);

    CheckpointWriter checkpoints;
    HistoryWriter history;  // refuses other columns; constructed before `results` deletes frames
    std::vector<HistoryWriter> lines;
    std::unique_ptr<ResultFile> results;
    PartnerFrames<D> partners;
    RevolvedFrames<D> revolved;
  };
  std::optional<Files> files_;
  std::int64_t last_frame_ = -1;
};

}  // namespace meniscus
