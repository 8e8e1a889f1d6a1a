// SPDX-License-Identifier: BSD-3-Clause
// Output of a run: rows of the history, frames and checkpoints, and when they are due.
#pragma once
#include "app/partner_frames.hpp"
#include "io/checkpoint.hpp"
#include "io/history.hpp"
#include "io/result_file.hpp"
#include "run/simulation.hpp"

namespace meniscus {

/// Writes what is due after each step of a run. All ranks find out what is written, the first one
/// has the files.
template <int D>
class Recorder {
 public:
  /// `continued`: the run goes on in the directory it was in before. Rows and frames after the
  /// present state are dropped: the run will make them again.
  Recorder(Simulation<D>& simulation, const RunDirectory& directory, const Provenance& provenance,
           bool continued);

  /// The run goes on as another simulation, the same scene with new references of bodies: a result
  /// file of its own begins, with a frame.
  void begin_epoch(Simulation<D>& simulation);
  /// Writes the row and frame that are due after a step that began at `before` (-1: the initial
  /// state), or because the end of the scene is reached. Returns the ledger if a row was written.
  std::optional<Ledger> record(Real before);
  void checkpoint();
  /// After a failed step: the frame before it if it was not written yet, without the state, which
  /// is not complete.
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
    HistoryWriter
        history;  // before the frames: it refuses other columns before anything is dropped
    std::vector<HistoryWriter> lines;
    std::unique_ptr<ResultFile> results;
    PartnerFrames<D> partners;
  };
  std::optional<Files> files_;
  std::int64_t last_frame_ = -1;
};

}  // namespace meniscus
