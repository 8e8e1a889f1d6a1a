// SPDX-License-Identifier: BSD-3-Clause
// The options of the commands that take a scene.
#pragma once
#include "app/commands.hpp"
#include "app/converge.hpp"
#include "app/sweep.hpp"

namespace CLI {
class App;
}

namespace meniscus {

/// Adds to a command what fills its request.
void add_scene_options(CLI::App& command, RunRequest& request);
void add_run_options(CLI::App& command, RunRequest& request);
void add_revolve_options(CLI::App& command, RevolveRequest& request);
void add_sweep_options(CLI::App& command, SweepRequest& request);
void add_converge_options(CLI::App& command, ConvergeRequest& request);

}  // namespace meniscus
