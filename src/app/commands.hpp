// SPDX-License-Identifier: BSD-3-Clause
// The commands of the program.
#pragma once
#include "input/input.hpp"
#include "input/units.hpp"
#include "numbers/types.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// Exit codes of the program.
enum ExitCode : int {
  exit_ok = 0,
  exit_internal = 1,
  exit_usage = 2,
  exit_input = 3,
  exit_numerical = 4,
  exit_file = 5,
  exit_expectation = 7,
  exit_signal = 128  ///< + number of the signal, after a checkpoint; 14 (alarm) for --max-walltime
};

struct RunRequest {
  std::string scene, output, restart, command_line;
  std::vector<std::string> set;
  std::vector<std::string> beside;  ///< scenes that follow the run, as "KEY=VALUE; KEY=VALUE"
  std::optional<std::int64_t> frame;
  std::string until;                   ///< a time such as "0.1 ns"; empty: the end
  std::optional<double> max_walltime;  ///< seconds
  int threads = 0;                     ///< 0: all cores
  bool overwrite = false, quiet = false;
  std::optional<StageChoice> stage;  ///< the stage to run, of a scene with stages
  std::string stages;                ///< directory of all its stages
};

/// Runs a scene to its end; returns an exit code. Throws InputError, SolveError, FileError.
int run(const RunRequest& request);

/// Reads and builds the scene without running it. Estimates the step, memory and duration, and
/// prints them.
void check(const RunRequest& request);

struct RevolveRequest {
  std::string scene, file;  ///< file: the new scene; empty: it is printed
  std::vector<std::string> set;
};

/// Writes the twin of a scene in the half plane of a body of revolution. Throws InputError with
/// what prevents it, FileError.
void revolve(const RevolveRequest& request);

/// The time of --until in units of the scene; infinity if none was given. Throws InputError.
Real time_to_stop(const RunRequest& request, const UnitSystem& units);

struct StudyRequest {
  std::string name, output, command_line;
  std::vector<int> levels;  ///< empty: the levels of the study
  std::vector<std::string> set;
  int threads = 0;  ///< 0: all cores
  bool brief = false;
};

/// Runs a study, prints its table and its checks, and writes study.csv and study.json to the output
/// directory (none if empty); returns exit_expectation if a check is missed. Throws as run().
int run_study(const StudyRequest& request);

/// Prints the known studies.
void list_studies();

/// Calls the command and returns its exit code. If the command throws, prints the message to stderr
/// and returns the exit code that belongs to the kind of exception.
int exit_code_of(const std::function<int()>& command);

}  // namespace meniscus
