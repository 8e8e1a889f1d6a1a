// SPDX-License-Identifier: BSD-3-Clause
// Restart: the state from which a run continues, and the directory of its results.
#pragma once
#include "app/commands.hpp"
#include "io/checkpoint.hpp"

namespace meniscus {

/// The directory given by --output, else the directory given by --restart, else results/SCENE.
std::filesystem::path output_directory(const RunRequest& request);

/// The state from which a run continues.
struct Restart {
  ReadCheckpoint from;
  bool in_place;  ///< new results are appended to the directory that was read
};

/// Reads the checkpoint that --restart names; empty without --restart. `input` is the completed
/// input of this run. Throws FileError if the checkpoint cannot be read, and InputError if it
/// belongs to a scene with other bodies, materials or loads.
std::optional<Restart> read_restart(const RunRequest& request, const std::string& input);

}  // namespace meniscus
