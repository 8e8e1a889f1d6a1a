// SPDX-License-Identifier: BSD-3-Clause
// `meniscus run`: runs a scene from its file to the last frame and returns the exit code.
#include "app/besides.hpp"
#include "app/commands.hpp"
#include "app/interruption.hpp"
#include "app/outputs.hpp"
#include "app/print.hpp"
#include "app/progress.hpp"
#include "app/recorder.hpp"
#include "app/restart.hpp"
#include "app/run_report.hpp"
#include "app/set_up.hpp"
#include "app/stages.hpp"
#include "app/warnings.hpp"
#include "io/run_log.hpp"
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"
#include "run/epochs.hpp"

#include <fmt/core.h>
#include <omp.h>

namespace meniscus {
namespace {

/// Requests to stop or to write a checkpoint, made by a signal to any rank or by its clock.
/// Identical on all ranks.
struct Asked {
  std::optional<int> signal;
  bool checkpoint;
};
Asked asked_anywhere(const Interruption& interruption, double next_checkpoint) {
  const std::int64_t due = interruption.elapsed_seconds() > next_checkpoint ? 1 : 0;
  const std::int64_t of_all = ranks().largest(2 * interruption.noticed().value_or(0) + due);
  return {of_all > 1 ? std::optional(static_cast<int>(of_all / 2)) : std::nullopt, of_all % 2 == 1};
}

/// Makes steps until the end of the scene, the time to stop, or a signal. Returns the signal, if
/// there was one. Steps depend on the scene alone, so that a run that was stopped anywhere
/// continues with the same bits.
template <int D>
std::optional<int> run_steps(Epochs<D>& epochs, Recorder<D>& recorder, Besides<D>& besides,
                             RunLog& log, const Interruption& interruption, Progress& progress,
                             Real stop) {
  const double checkpoint_seconds = 60 * epochs.scene().output.checkpoint_minutes;
  double next_checkpoint = interruption.elapsed_seconds() + checkpoint_seconds;
  const auto warn = [&](const std::string& sentence) {
    progress.finish();  // end the progress line before a warning
    log.warning(sentence);
  };
  Warnings<D> warnings(epochs.simulation(), warn);
  while (epochs.simulation().state().time < stop && !epochs.simulation().finished()) {
    const Asked asked = asked_anywhere(interruption, next_checkpoint);
    if (asked.signal) return asked.signal;
    if (asked.checkpoint) {
      recorder.checkpoint();
      next_checkpoint = interruption.elapsed_seconds() + checkpoint_seconds;
    }
    const Real before = epochs.simulation().state().time;
    const typename Epochs<D>::Remapped remapped = epochs.advance();
    Simulation<D>& simulation = epochs.simulation();
    if (!remapped.notes.empty()) progress.finish();
    for (const std::string& note : remapped.notes) log.info(note);
    for (const std::string& warning : remapped.warnings) warn(warning);
    if (remapped.new_epoch) {
      warnings.follow(simulation);
      recorder.begin_epoch(simulation);
    }
    const auto ledger = recorder.record(before);
    progress.show(simulation.state(), simulation.last_step(), ledger);
    if (ledger) besides.record(simulation);
    if (ledger) warnings.look(*ledger);
    if (const auto warning = simulation.controller().take_warning()) warn(*warning);
    for (const std::string& note : simulation.take_notes()) {
      progress.finish();
      log.info(note);
    }
  }
  return std::nullopt;
}

/// After a numerical failure: logs the cause and writes the last valid frame. Returns the exit
/// code.
template <int D>
int end_failed(const SolveError& error, bool quiet, Recorder<D>& recorder, RunLog& log) {
  log.error(error.what());
  if (!ranks().all_come()) {  // no more collective calls from here on
    keep_complaint(error.what());
    return exit_numerical;
  }
  repeat_warnings(quiet, log);
  recorder.write_last_good_frame();
  return exit_numerical;
}

/// Makes the run and records it in its directory, which is already open.
template <int D>
int run_recorded(Epochs<D>& epochs, Besides<D>& besides, const RunRequest& request,
                 const Provenance& origin, const std::optional<Restart>& restart,
                 const Interruption& interruption, double begun, Real stop,
                 const RunDirectory& directory, RunLog& log) {
  const bool in_place = restart && restart->in_place;
  const State& begin = epochs.simulation().state();
  if (in_place) {  // write a checkpoint before later rows are removed
    const Snapshot snapshot = epochs.simulation().snapshot_of_first_rank();
    on_first_rank(
        [&] { CheckpointWriter(directory, origin).write(begin.step, begin.time, snapshot); });
  }
  Recorder<D> recorder(epochs.simulation(), directory, origin, in_place);
  besides.open(directory);
  Progress progress(begin, stop,
                    {epochs.scene().units.symbol(dimension::time),
                     epochs.scene().symbol_of_sum(dimension::energy),
                     !epochs.simulation().stepper().residuals(begin).empty()},
                    Progress::for_stdout(request.quiet),
                    [&log](const std::string& line) { log.info(line); });
  const std::int64_t first_step = begin.step;
  const double before_steps = interruption.elapsed_seconds();
  bool has_begun = restart.has_value();
  std::optional<int> signal;
  try {
    epochs.simulation().stop_when([&] {
      const Simulation<D>& now = epochs.simulation();
      progress.within(now.state(), now.last_step(), now.stepper().doing());
      return interruption.requested().has_value();
    });
    if (!restart) {
      epochs.simulation().settle();
      recorder.record(-1);
      besides.record(epochs.simulation());
      has_begun = true;
    }
    signal = run_steps(epochs, recorder, besides, log, interruption, progress, stop);
  } catch (const Interrupted&) {
    signal = interruption.requested();
  } catch (const SolveError& e) {
    progress.finish();
    return end_failed(e, request.quiet, recorder, log);
  }
  progress.finish();
  if (!has_begun) {
    log.warning(fmt::format("stopped by {} before the first state was found: nothing to continue",
                            name_of(signal.value())));
    return exit_signal + *signal;
  }
  recorder.checkpoint();

  Simulation<D>& simulation = epochs.simulation();
  const std::string summary =
      summarise(simulation, first_step,
                {before_steps - begun, interruption.elapsed_seconds() - before_steps});
  report_contacts(simulation.scene().system, log);
  log.info(summary);
  report_ranks(simulation.scene().system, simulation.state().step - first_step, log);
  if (!request.quiet) say("{}\nresults in {}\n", summary, directory.path().string());
  repeat_warnings(request.quiet, log);
  if (!signal) {
    const bool rest = report_rest(simulation, log);
    const int expected = report_expectations(simulation, directory, log);
    return rest ? expected : exit_numerical;
  }
  say_how_to_continue(simulation, *signal,
                      request.stage ? request.stages : directory.path().string(), log);
  return exit_signal + *signal;
}

/// Opens the run directory on rank 0, after all ranks have read the checkpoint to continue from.
std::unique_ptr<RunDirectory> opened_directory(const std::filesystem::path& path,
                                               ExistingRun existing) {
  std::unique_ptr<RunDirectory> directory;
  ranks().largest(0);
  on_first_rank([&] { directory = std::make_unique<RunDirectory>(path, existing); });
  return directory ? std::move(directory)
                   : std::make_unique<RunDirectory>(path, ExistingRun::leave);
}

RunLog opened_log(const RunDirectory& directory) {
  RunLog log = RunLog::silent();
  on_first_rank([&] { log = RunLog(directory.log_file()); });
  return log;
}

/// Hash of the initial positions of all nodes, to detect ranks that have read different meshes.
template <int D>
std::string mark_of_places(const Plan<D>& plan) {
  Fnv1a hash;
  for (const BodyPlan<D>& body : plan.bodies)
    for (const Vec<D>& X : body.geometry.grid.X)
      hash.add({reinterpret_cast<const char*>(X.data()), sizeof(Real) * D});
  return fmt::format("{:016x}", hash.value());
}

template <int D>
int run_scene(const SceneInput& input, const RunRequest& request, Interruption& interruption) {
  const double begun = interruption.elapsed_seconds();
  Plan<D> plan = set_up(input, [&] { return read_plan<D>(input); });
  require_alike(mark_of_places(plan), "mesh");
  const std::string complete = plan.complete;
  constexpr Real of_rounding = 1e-9;  // eight steps of 0.1 s come to 0.7999999999999999 s
  const Real until = time_to_stop(request, plan.units),
             stop = until < plan.time.end ? until * (1 - of_rounding) : plan.time.end;
  const std::optional<Restart> restart = read_restart(request, complete);
  const Snapshot* state = restart ? &restart->from.checkpoint.state : nullptr;

  const auto epochs =
      set_up(input, [&] { return std::make_unique<Epochs<D>>(std::move(plan), state); });
  require_known_outputs(input, epochs->scene());
  if (!restart) set_up(input, [&] { epochs->simulation().begin(); });
  Besides<D> besides(request);

  interruption.catch_signals();  // until here nothing is lost if the program ends at once
  const std::unique_ptr<RunDirectory> directory =
      opened_directory(output_directory(request), restart && restart->in_place ? ExistingRun::keep
                                                  : request.overwrite ? ExistingRun::replace
                                                                      : ExistingRun::refuse);
  RunLog log = opened_log(*directory);
  const Provenance origin = provenance(request.command_line, complete);
  introduce(epochs->scene(), origin, restart, epochs->simulation().controller().stable(), log);
  for (const std::string& note : epochs->simulation().take_notes()) log.info(note);
  if (!restart) report_residuals(epochs->simulation(), log);
  try {
    return run_recorded(*epochs, besides, request, origin, restart, interruption, begun, stop,
                        *directory, log);
  } catch (const FileError& e) {
    log.error(e.what());
    keep_complaint(e.what());
    return exit_file;
  }
}

}  // namespace

int run_scene(const SceneInput& input, const RunRequest& request, Interruption& interruption) {
  return scene_dimension(input) == 2 ? run_scene<2>(input, request, interruption)
                                     : run_scene<3>(input, request, interruption);
}

int run(const RunRequest& request) {
  if (request.threads > 0) omp_set_num_threads(request.threads);
  Interruption interruption(request.max_walltime);
  std::optional<SceneInput> read;
  std::vector<std::string> stages;
  on_each_rank([&] {
    read.emplace(SceneInput::from_file(request.scene, request.set));
    stages = read->stages();
  });
  require_alike(read->text(), fmt::format("scene '{}'", request.scene));
  if (stages.empty()) return run_scene(*read, request, interruption);
  return run_stages(request, stages, [&](const SceneInput& input, const RunRequest& of_stage) {
    return run_scene(input, of_stage, interruption);
  });
}

}  // namespace meniscus
