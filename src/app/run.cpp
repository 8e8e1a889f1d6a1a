// SPDX-License-Identifier: BSD-3-Clause
// Running a scene: from the file to the last frame, and back to the shell with an exit code.
#include <fmt/format.h>
#include <omp.h>

#include <set>
#include <sstream>

#include "meniscus/app/commands.hpp"
#include "meniscus/app/interruption.hpp"
#include "meniscus/app/progress.hpp"
#include "meniscus/app/recorder.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/run_log.hpp"
#include "meniscus/scene/expectations.hpp"

namespace meniscus {
namespace {

/// The tables of a complete input that decide what is simulated: all but [time], [output], [expect].
std::string physics_of(const std::string& complete) {
  std::istringstream lines(complete);
  std::string line, kept;
  bool keep = true;
  while (std::getline(lines, line)) {
    if (line.starts_with("["))
      keep = !line.starts_with("[time") && !line.starts_with("[output") && !line.starts_with("[expect");
    if (keep && !line.empty()) kept += line + "\n";
  }
  return kept;
}

struct Restart {
  std::optional<ReadCheckpoint> from;
  bool in_place = false;  ///< the run goes on in the directory it was in before
};

Restart read_restart(const RunRequest& request, const std::filesystem::path& output,
                     const std::string& input) {
  if (request.restart.empty()) return {};
  Restart restart{read_checkpoint(request.restart, request.frame), false};
  std::filesystem::path directory = request.restart;
  if (!std::filesystem::is_directory(directory)) directory = directory.parent_path();
  restart.in_place = std::filesystem::exists(output) &&
                     std::filesystem::equivalent(directory.empty() ? "." : directory, output);
  if (physics_of(restart.from->checkpoint.input) != physics_of(input))
    throw InputError(fmt::format(
        "{} was written by a different scene: bodies, materials or loads differ; continue with the "
        "scene it was written by (only [time], [output] and [expect] may change)",
        restart.from->file.string()));
  return restart;
}

std::filesystem::path output_directory(const RunRequest& request) {
  if (!request.output.empty()) return request.output;
  if (!request.restart.empty() && std::filesystem::is_directory(request.restart))
    return request.restart;
  return std::filesystem::path("results") / std::filesystem::path(request.scene).stem();
}

template <int D>
int report_expectations(const Scene<D>& scene, const RunDirectory& directory, bool stopped_early,
                        RunLog& log) {
  if (scene.expectations.empty()) return exit_ok;
  const History history = History::read(directory.history_file());
  const auto results = evaluate_expectations(
      scene.expectations,
      [&](const std::string& name) -> const std::vector<Real>& { return history.column(name); },
      stopped_early);
  const std::string table = expectation_table(results);
  fmt::print("{}", table);
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) log.info(line);
  for (const auto& r : results)
    if (r.reached && !r.met) return exit_expectation;
  return exit_ok;
}

/// States that a law should not be trusted in; said once per body.
template <int D>
void warn_doubtful(const Simulation<D>& simulation, std::set<std::string>& said, RunLog& log) {
  for (const auto& term : simulation.scene().system.terms) {
    if (said.contains(term->name())) continue;
    if (const auto warning = term->warning(simulation.state().motion())) {
      log.warning(fmt::format("t = {:.6g}: {}", simulation.state().time, *warning));
      said.insert(term->name());
    }
  }
}

/// Steps to the end, or until asked to stop.
template <int D>
std::optional<int> run_steps(Simulation<D>& simulation, Recorder<D>& recorder, RunLog& log,
                             const Interruption& interruption, Progress& progress, Real end) {
  const double checkpoint_seconds = 60 * simulation.scene().output.checkpoint_minutes;
  double next_checkpoint = checkpoint_seconds;
  std::set<std::string> said;
  while (simulation.state().time < end) {
    const Real before = simulation.state().time;
    try {
      simulation.advance(end);
      const auto ledger = recorder.record(before, end);
      progress.show(simulation.state(), simulation.last_step(), ledger,
                    interruption.elapsed_seconds());
      if (ledger) warn_doubtful(simulation, said, log);
    } catch (const SolveError&) {
      recorder.write_failed_frame();
      throw;
    }
    if (const auto warning = simulation.controller().take_warning()) log.warning(*warning);
    if (interruption.elapsed_seconds() > next_checkpoint) {
      recorder.checkpoint();
      next_checkpoint = interruption.elapsed_seconds() + checkpoint_seconds;
    }
    if (const auto signal = interruption.requested(); signal && simulation.state().time < end) {
      const auto file = recorder.checkpoint();
      log.warning(fmt::format("stopped at step {}, t = {:.9g}, by {}; continue with --restart {}",
                              simulation.state().step, simulation.state().time,
                              *signal == 14 ? "the limit on wall-clock time" : fmt::format("signal {}", *signal),
                              file.parent_path().string()));
      return exit_signal + *signal;
    }
  }
  return std::nullopt;
}

template <int D>
int run_scene(const SceneInput& input, const RunRequest& request) {
  const Interruption interruption(request.max_walltime);
  Scene<D> scene = build_scene<D>(input);
  const std::string complete = input.complete();
  const Real end = std::min(scene.time.end, request.until.value_or(1e300));
  const std::filesystem::path output = output_directory(request);
  const Restart restart = read_restart(request, output, complete);

  Simulation<D> simulation(scene);
  if (restart.from)
    simulation.restore(restart.from->checkpoint.state);
  else
    simulation.begin();

  const RunDirectory directory(output, restart.in_place    ? ExistingRun::keep
                                       : request.overwrite ? ExistingRun::replace
                                                           : ExistingRun::refuse);
  RunLog log(directory.log_file());
  const Provenance origin = provenance(request.command_line, complete);
  log.info(fmt::format("meniscus {} ({}), {} threads: {}", origin.build.version,
                       origin.build.git_hash, origin.threads, origin.command_line));
  for (const auto& note : scene.notes) log.info(note);
  for (const auto& warning : scene.warnings) log.warning(warning);
  if (restart.from)
    for (const auto& warning : restart.from->warnings) log.warning(warning);
  log.info(fmt::format("stable step {:.6g} {}", simulation.controller().stable().dt,
                       scene.units.symbol(dimension::time)));

  Recorder<D> recorder(simulation, directory, origin, restart.in_place);
  if (!restart.in_place) recorder.record(-1, end);
  Progress progress(simulation.state().time, end, scene.units.symbol(dimension::time),
                    scene.units.symbol(dimension::energy), request.quiet);
  const std::int64_t first_step = simulation.state().step;
  const double set_up_seconds = interruption.elapsed_seconds();
  std::optional<int> stopped;
  try {
    stopped = run_steps(simulation, recorder, log, interruption, progress, end);
  } catch (const SolveError& e) {
    progress.finish();
    log.error(e.what());
    throw;
  }
  progress.finish();
  const double seconds = interruption.elapsed_seconds() - set_up_seconds;
  const auto steps = static_cast<Real>(simulation.state().step - first_step);
  const std::string summary = fmt::format(
      "{} steps in {:.2f} s ({:.0f} ns per particle-step), set-up {:.2f} s, state {:016x}", steps,
      seconds, 1e9 * seconds / std::max(1.0, steps) / scene.system.size(), set_up_seconds,
      simulation.snapshot().hash());
  log.info(summary);
  if (!request.quiet) fmt::print("{}\nresults in {}\n", summary, directory.path().string());
  if (stopped) return *stopped;
  recorder.checkpoint();
  return report_expectations(scene, directory, end < scene.time.end, log);
}

}  // namespace

int run(const RunRequest& request) {
  if (request.threads > 0) omp_set_num_threads(request.threads);
  const SceneInput input = SceneInput::from_file(request.scene, request.set);
  return scene_dimension(input) == 2 ? run_scene<2>(input, request) : run_scene<3>(input, request);
}

}  // namespace meniscus
