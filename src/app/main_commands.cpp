// SPDX-License-Identifier: BSD-3-Clause
// The options of the commands that take a scene.
#include "app/main_commands.hpp"

#include "app/child.hpp"
#include "app/interruption.hpp"
#include "app/main_options.hpp"
#include "meniscus/error.hpp"

#include <CLI/CLI.hpp>

#include <climits>
#include <string>
#include <vector>

namespace meniscus {
namespace {

void add_set_option(CLI::App& command, std::vector<std::string>& settings) {
  command.add_option("--set", settings, "replace a key of the scene, e.g. time.end='1 ns'")
      ->type_name("KEY=VALUE")
      ->type_size(1)
      ->allow_extra_args(false);
}

/// --refine K, which sets resolution.refine.
void add_refine_option(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option_function<std::string>(
          "--refine",
          [&settings](const std::string& k) { settings.push_back("resolution.refine=" + k); },
          "make the cells of all bodies finer by this number, as --set resolution.refine=K")
      ->type_name("K")
      ->check(not_empty());
}

/// Options of a command that makes several runs: `name` ends the name of their directory.
template <class Request>
void add_series_options(CLI::App& command, Request& request, const std::string& name) {
  command
      .add_option("--output", request.output,
                  "directory of the tables and of the runs; results/SCENE-" + name + " by default")
      ->type_name("DIR")
      ->check(not_empty());
  command.add_option("--threads", request.threads, "number of threads; all cores by default")
      ->check(integer_between(1, 4096));
  command.add_flag("--overwrite", request.overwrite,
                   "begin anew; without it runs that are done stay, and others go on");
}

}  // namespace

void add_scene_options(CLI::App& command, RunRequest& request) {
  command.add_option("SCENE", request.scene, "scene file (TOML)")->required()->check(not_empty());
  add_set_option(command, request.set);
  add_refine_option(command, request.set);
  command.add_option("--threads", request.threads, "number of threads; all cores by default")
      ->check(integer_between(1, 4096));
  command
      .add_option(
          "--until", request.until,
          "stop after the first step that reaches this time, e.g. '0.1 ns', with a "
          "checkpoint. Steps, rows and frames are those of the whole run, so that --restart "
          "continues it bit for bit (the end of the scene, time.end, is hit exactly)")
      ->type_name("TIME")
      ->check(not_empty());
}

void add_run_options(CLI::App& command, RunRequest& request) {
  command
      .add_option("--output", request.output,
                  "directory of the results; by default results/SCENE, or DIR of --restart DIR")
      ->type_name("DIR")
      ->check(not_empty());
  command.add_flag("--overwrite", request.overwrite, "replace results that are already there");
  CLI::Option* restart =
      command
          .add_option(
              "--restart", request.restart,
              "continue bit for bit from a checkpoint, or from the newest one of a run; any "
              "number of threads. Only [time], [output] and [expect] of the scene may "
              "change, and in the same directory neither fields nor columns. A finished run goes "
              "on if time.end is made larger; its last two "
              "steps, which were fitted to the old end, stay")
          ->type_name("FILE|DIR")
          ->check(not_empty());
  command
      .add_option("--frame", request.frame,
                  "continue from this frame of the run instead; later rows and frames are replaced")
      ->type_name("K")
      ->check(integer_between(0, INT_MAX))
      ->needs(restart);
  command
      .add_option_function<std::string>(
          "--max-walltime",
          [&request](const std::string& text) {
            request.max_walltime = parse_duration(text);
            if (!request.max_walltime)
              throw CLI::ValidationError(
                  "--max-walltime", "'" + text + "' is not a time; write H:M:S, M:S or seconds");
          },
          "write a checkpoint and stop after this time, exit code 142")
      ->type_name("H:M:S");
  command
      .add_option("--beside", request.beside,
                  "also follow the equilibria of this scene with these keys changed slightly, in "
                  "beside-1.csv, beside-2.csv, ...; for derivatives, of scenes with newton")
      ->type_name("KEY=VALUE;KEY=VALUE")
      ->type_size(1)
      ->allow_extra_args(false)
      ->excludes(restart);
  command.add_flag("-q,--quiet", request.quiet, "print nothing but errors and expectations");
}

void add_revolve_options(CLI::App& command, RevolveRequest& request) {
  command.add_option("SCENE", request.scene, "scene file (TOML) with dimension = 3")
      ->required()
      ->check(not_empty());
  command.add_option("NEW", request.file, "the new scene file; printed if not given")
      ->check(not_empty());
  add_refine_option(command, request.set);
  add_set_option(command, request.set);
}

void add_sweep_options(CLI::App& command, SweepRequest& request) {
  command.add_option("SCENE", request.scene, "scene file (TOML)")->required()->check(not_empty());
  command
      .add_option("--set", request.set,
                  "run with each of the values; several --set: with all combinations")
      ->type_name("KEY=VALUE,VALUE,...")
      ->required()
      ->type_size(1)
      ->allow_extra_args(false);
  command
      .add_option("--random", request.random,
                  "instead this number of runs, a Latin hypercube between the two values of each "
                  "--set")
      ->type_name("N")
      ->check(integer_between(1, 100000));
  command
      .add_option("--parallel", request.parallel,
                  "number of runs at the same time, which share the cores; 1 by default")
      ->type_name("N")
      ->check(integer_between(1, Children::most));
  add_series_options(command, request, "sweep");
}

void add_converge_options(CLI::App& command, ConvergeRequest& request) {
  command.add_option("SCENE", request.scene, "scene file (TOML)")->required()->check(not_empty());
  command.add_option("--levels", request.levels, "number of resolutions; 3 by default")
      ->check(integer_between(3, 10));
  command
      .add_option(
          "--factor", request.factor,
          "by which the cells of a level are finer than those before; 2 by default, in 3D 1.5")
      ->check(CLI::Range(1.05, 4.0));
  command
      .add_option("--of", request.of,
                  "a column of the history whose last value is reported beside the expectations")
      ->type_name("COLUMN")
      ->type_size(1)
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--range",
          [&request](const std::string& word) { request.hold_lengths = word == "fixed"; },
          "lengths that the scene leaves to the cells, such as the range of a contact: "
          "fixed, as in the first level, or with the cells; with by default")
      ->check(CLI::IsMember({"fixed", "with"}));
  command.add_flag("--budget", request.budget,
                   "also vary the ranges and bulk moduli of fluids, the step of dynamics and the "
                   "tolerances of relax, for a table of all errors of the scene itself");
  add_set_option(command, request.set);
  add_series_options(command, request, "convergence");
}

}  // namespace meniscus
