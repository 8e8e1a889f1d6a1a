// SPDX-License-Identifier: BSD-3-Clause
// Saved states of a run, and reading one to continue from it.
//
// DIR/checkpoint-a.h5 and DIR/checkpoint-b.h5 are written in turn, each beside its old version and
// then renamed: at every moment one complete checkpoint is on the disk. The first 512
// bytes of a file are a text (`head -n 3`) with the serial number and a checksum over the rest;
// then come /state, /meta with the complete input, and the attributes step and time.
#pragma once
#include "io/provenance.hpp"
#include "io/run_directory.hpp"
#include "state/snapshot.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

struct Checkpoint {
  std::int64_t step = 0;
  Real time = 0;
  Snapshot state;
  std::string input;  ///< the complete input of the run that wrote it
};

/// Writes the checkpoints of a run, in turn.
class CheckpointWriter {
 public:
  /// Later checkpoints count as newer than those already in the directory, whatever their step.
  CheckpointWriter(const RunDirectory&, Provenance);

  /// Replaces the older of the two files. When it returns, the checkpoint is on the disk.
  /// Throws SolveError if the state is not finite, FileError if it cannot be written; the newest
  /// checkpoint before stays valid. Returns the path of the file.
  std::filesystem::path write(std::int64_t step, Real time, const Snapshot& state);

 private:
  std::filesystem::path directory_;
  Provenance provenance_;
  std::int64_t serial_ = 0;       ///< of the newest checkpoint
  std::filesystem::path newest_;  ///< empty if there is none
};

struct ReadCheckpoint {
  Checkpoint checkpoint;
  std::filesystem::path file;
  /// Warnings: damaged files that were skipped; a state written by another program or build.
  std::vector<std::string> warnings;
};

/// Reads the state to continue from. `path` is one of:
/// - a checkpoint file;
/// - the directory of a run: its newest valid checkpoint is read;
/// - with `frame`, a result file or the directory of a run: this frame is read if it holds the
///   state. Frames of a directory are counted over all of its result files.
/// Every state is checked against its stored hash, and its numbers are finite. Throws FileError if
/// nothing valid is found.
ReadCheckpoint read_checkpoint(const std::filesystem::path& path,
                               std::optional<std::int64_t> frame = {});

}  // namespace meniscus
