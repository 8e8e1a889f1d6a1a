// SPDX-License-Identifier: BSD-3-Clause
// Runs the stages of a scene one after the other.
#pragma once
#include "app/commands.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace meniscus {

/// True if a run has left a state in this directory. Only rank 0 looks.
bool has_checkpoint(const std::filesystem::path& directory);

/// The request to run one stage, in a directory of its own in `directory`. It begins with the last
/// state of the stage before.
RunRequest request_of_stage(const RunRequest& all, const std::vector<std::string>& names,
                            std::size_t number, const std::filesystem::path& directory);

/// Runs one scene and returns its exit code.
using RunOne = std::function<int(const SceneInput&, const RunRequest&)>;

/// Runs the stages called `names`; with --restart from the last stage that has a state. All are
/// read and built before the first runs, so that a mistake in the last one is found at once. Ends
/// after a stage that fails or that a signal ends. A missed expectation is the exit code, but the
/// next stages run. Throws like run().
int run_stages(const RunRequest& request, const std::vector<std::string>& names,
               const RunOne& run_one);

}  // namespace meniscus
