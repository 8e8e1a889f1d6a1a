// SPDX-License-Identifier: BSD-3-Clause
// Restart: the state a run continues from, and the directory of its results.
#pragma once
#include "app/commands.hpp"
#include "io/checkpoint.hpp"

namespace meniscus {

/// --output, else the directory given to --restart, else results/SCENE.
std::filesystem::path output_directory(const RunRequest& request);

/// The state to continue from.
struct Restart {
  ReadCheckpoint from;
  bool in_place;  ///< the results are continued where they are
};

/// Reads what --restart names; nothing without it. `input` is the complete input of this run.
/// Throws FileError, and InputError if the state was written by a scene with other bodies,
/// materials or loads.
std::optional<Restart> read_restart(const RunRequest& request, const std::string& input);

}  // namespace meniscus
