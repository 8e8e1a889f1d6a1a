// SPDX-License-Identifier: BSD-3-Clause
// Running a scene: from the file to the last frame, and back to the shell with an exit code.
#include "app/commands.hpp"
#include "app/interruption.hpp"
#include "app/outputs.hpp"
#include "app/print.hpp"
#include "app/progress.hpp"
#include "app/recorder.hpp"
#include "app/restart.hpp"
#include "app/set_up.hpp"
#include "app/warnings.hpp"
#include "io/run_log.hpp"
#include "measure/drop_measures.hpp"
#include "meniscus/error.hpp"
#include "parallel/memory.hpp"
#include "parallel/ranks.hpp"
#include "physics/contact/pair/contact_visits.hpp"
#include "run/epochs.hpp"
#include "scene/expectations.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <sstream>

namespace meniscus {
namespace {

template <int D>
int report_expectations(const Simulation<D>& simulation, const RunDirectory& directory,
                        RunLog& log) {
  auto expectations = simulation.scene().expectations;
  if (expectations.empty()) return exit_ok;
  Real end = simulation.scene().time.end;
  if (simulation.finished()) {  // what has come to rest stays as it is
    end = simulation.state().time;
    for (auto& [name, e] : expectations)
      for (std::optional<Real>* time : {&e.at, &e.to})
        if (*time) *time = std::min(**time, end);
  }
  bool met = true;
  on_first_rank([&] {
    const History history = History::read(directory.history_file());
    const auto results = evaluate_expectations(
        expectations,
        [&](const std::string& name) -> const std::vector<Real>& { return history.column(name); },
        end);
    const std::string table = expectation_table(results);
    say("{}", table);
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) log.info(line);
    for (const auto& r : results) met &= !r.reached || r.met;
  });
  return ranks().largest(met ? exit_ok : exit_expectation) == exit_ok ? exit_ok : exit_expectation;
}

/// What the clocks of the ranks and signals to any of them ask for, the same on all.
struct Asked {
  std::optional<int> signal;
  bool checkpoint;
};
Asked asked_anywhere(const Interruption& interruption, double next_checkpoint) {
  const std::int64_t due = interruption.elapsed_seconds() > next_checkpoint ? 1 : 0;
  const std::int64_t of_all = ranks().largest(2 * interruption.noticed().value_or(0) + due);
  return {of_all > 1 ? std::optional(static_cast<int>(of_all / 2)) : std::nullopt, of_all % 2 == 1};
}

/// Steps until the end of the scene, the time to stop, or a request to; returns the signal of the
/// request, if there was one. Only what the scene says decides the steps, so that a run that was
/// stopped anywhere goes on as if it had not been.
template <int D>
std::optional<int> run_steps(Epochs<D>& epochs, Recorder<D>& recorder, RunLog& log,
                             const Interruption& interruption, Progress& progress, Real stop) {
  const double checkpoint_seconds = 60 * epochs.scene().output.checkpoint_minutes;
  double next_checkpoint = interruption.elapsed_seconds() + checkpoint_seconds;
  const auto warn = [&](const std::string& sentence) {
    progress.finish();  // the line is not to be written on
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
    if (ledger) warnings.look(*ledger);
    if (const auto warning = simulation.controller().take_warning()) warn(*warning);
    for (const std::string& note : simulation.take_notes()) {
      progress.finish();
      log.info(note);
    }
  }
  return std::nullopt;
}

template <int D>
void introduce(const Scene<D>& scene, const Provenance& origin,
               const std::optional<Restart>& restart, const StableStep& stable, RunLog& log) {
  const std::string ranks_of_run =
      ranks().alone() ? std::string() : fmt::format("{} ranks of ", ranks().size());
  log.info(fmt::format("meniscus {} ({}), {}{} threads: {}", origin.build.version,
                       origin.build.git_hash, ranks_of_run, origin.threads, origin.command_line));
  for (const auto& note : scene.notes) log.info(note);
  for (const auto& warning : scene.warnings) log.warning(warning);
  if (restart) {
    for (const auto& warning : restart->from.warnings) log.warning(warning);
    log.info(fmt::format("continuing from step {} of {}", restart->from.checkpoint.step,
                         restart->from.file.string()));
  }
  if (stable.dt > 0)  // it was looked for
    log.info(fmt::format("stable step {:.6g} {}", stable.dt, scene.units.symbol(dimension::time)));
}

/// How far the drops are from equilibrium at the start.
template <int D>
void report_residuals(const Simulation<D>& simulation, RunLog& log) {
  const State& state = simulation.state();
  for (const std::size_t b : simulation.scene().drops()) {
    const BodyTension& tension = *simulation.scene().bodies[b].tension;
    const Body<D>& body = simulation.scene().system.bodies[b];
    const auto force =
        std::span<const NodalVector>(state.force)
            .subspan(static_cast<std::size_t>(body.first), static_cast<std::size_t>(body.size()));
    log.info(fmt::format("body '{}': residual force of the start: {:.2g} of the capillary force",
                         body.name,
                         capillary_residual<D>(force, tension.gamma, tension.area(state.motion()),
                                               tension.volume(state.motion()))));
  }
}

/// Of the state alone: the audit has scales of what was exchanged so far, as seen when rows of the
/// history were written, and how often that is changes no result.
std::uint64_t hash_of_state(const Snapshot& snapshot) {
  Snapshot state;
  for (const auto& [name, array] : snapshot.arrays())
    if (!name.starts_with("audit/")) state.add(name, array);
  return state.hash();
}

template <int D>
std::string summarise(Simulation<D>& simulation, std::int64_t first_step, double set_up_seconds,
                      const Interruption& interruption) {
  const double seconds = interruption.elapsed_seconds() - set_up_seconds;
  const std::int64_t steps = simulation.state().step - first_step;
  const Real particle_steps =
      static_cast<Real>(std::max<std::int64_t>(1, steps)) * simulation.scene().system.size();
  const std::string effort = simulation.stepper().effort();
  return fmt::format(
      "{} steps in {:.2f} s ({:.0f} ns per particle-step{}{}), set-up {:.2f} s, state {:016x}",
      steps, seconds, 1e9 * seconds / particle_steps, effort.empty() ? "" : ", ", effort,
      set_up_seconds, hash_of_state(simulation.snapshot_of_first_rank()));
}

/// What the ranks have sent and held since the beginning of the run.
template <int D>
void report_ranks(const System<D>& system, std::int64_t steps, RunLog& log) {
  if (ranks().alone()) return;
  log.info(system.halo
               ? fmt::format("a rank makes its steps on {} of {} particles at most, {} of them "
                             "ghosts",
                             ranks().largest(system.halo->size()), system.size(),
                             ranks().largest(system.halo->ghosts()))
               : "all ranks make their steps on all particles");
  const Traffic sent = ranks().traffic();
  const std::int64_t messages = ranks().largest(sent.messages), bytes = ranks().largest(sent.bytes),
                     memory = ranks().largest(static_cast<std::int64_t>(peak_memory())),
                     divisor = std::max<std::int64_t>(1, steps);
  log.info(fmt::format(
      "{} ranks: at most {} messages of {} bytes in all sent by one, {:.1f} of {:.0f} per step; at "
      "most {:.0f} MB of memory",
      ranks().size(), messages, bytes, static_cast<double>(messages) / static_cast<double>(divisor),
      static_cast<double>(bytes) / static_cast<double>(divisor),
      1e-6 * static_cast<double>(memory)));
}

/// Pairs that the contacts visited per force, beside those of all other terms.
template <int D>
void report_contacts(const System<D>& system, RunLog& log) {
  Offset others = 0;
  for (const auto& term : system.terms)
    if (!dynamic_cast<const ContactVisits*>(term.get())) others += term->pairs();
  for (const auto& term : system.terms)
    if (const auto* contact = dynamic_cast<const ContactVisits*>(term.get()))
      log.info(
          fmt::format("{}: {:.0f} pairs of contact points visited per force, beside {} pairs of "
                      "points and particles of the forces that are no contact",
                      term->name(), contact->pairs_per_force(), others));
}

/// Says whether the state at which a run has arrived is stable; false if it is not.
template <int D>
bool report_stability(Simulation<D>& simulation, const std::string& time, RunLog& log) {
  simulation.complete_state();
  const std::optional<Real> least = simulation.stepper().stability(simulation.state());
  if (!least)
    log.info(
        "it is not known whether this rest is stable: that is tested for solids of up to 1000 "
        "particles (2D: 5000) whose forces all have a potential; solver = \"newton\" tests more "
        "particles");
  if (!least || *least >= 0) return true;
  log.error(fmt::format(
      "the equilibrium at {} is not stable: its least stiffness is {:.3g} of that of the material, "
      "and the slightest disturbance grows; solver = \"newton\" leaves such states, and so does an "
      "imperfection of the body, such as an initial_displacement without the symmetry of the scene",
      time, *least));
  return false;
}

/// Says whether the bodies are at rest, at a state that is stable; false if they should be, but are
/// not.
template <int D>
bool report_rest(Simulation<D>& simulation, RunLog& log) {
  const State& state = simulation.state();
  const std::vector<Residual> residuals = simulation.stepper().residuals(state);
  if (residuals.empty() || !simulation.finished()) return true;
  std::string measures;
  for (const Residual& r : residuals)
    measures +=
        fmt::format("{}{} {:.3g}{}", measures.empty() ? "" : ", ", r.meaning, r.value,
                    r.allowed ? fmt::format(" (allowed {:.3g})", *r.allowed) : std::string());
  const std::string obstacle = simulation.stepper().obstacle(state),
                    time = fmt::format("t = {:.6g} {}", state.time,
                                       simulation.scene().units.symbol(dimension::time));
  const bool rest = simulation.stepper().arrived();
  if (rest)
    log.info(fmt::format("at rest at {}: {}", time, measures));
  else
    log.error(fmt::format("not at rest at {}: {}; {}", time, measures,
                          obstacle.empty()
                              ? "a later time.end gives more time, if there is an equilibrium"
                              : obstacle + ", which nothing balances"));
  return rest && report_stability(simulation, time, log);
}

std::string name_of(int signal) {
  return signal == SIGALRM ? "the limit on wall-clock time" : fmt::format("signal {}", signal);
}

template <int D>
void say_how_to_continue(const Simulation<D>& simulation, int signal, const RunDirectory& directory,
                         RunLog& log) {
  log.warning(fmt::format(
      "stopped after step {}, t = {:.9g} {}, by {}; to continue, run the same command with "
      "--restart {}",
      simulation.state().step, simulation.state().time,
      simulation.scene().units.symbol(dimension::time), name_of(signal),
      directory.path().string()));
}

/// All warnings of the run together: where they came, much was said after them.
void repeat_warnings(bool quiet, RunLog& log) {
  const auto warnings = log.warnings();
  if (warnings.empty()) return;
  int count = 0;
  for (const auto& [text, times] : warnings) count += times;
  std::vector<std::string> lines{fmt::format("{} warning{}:", count, count == 1 ? "" : "s")};
  for (const auto& [text, times] : warnings)
    lines.push_back(
        fmt::format("  {}{}", text, times == 1 ? "" : fmt::format(" ({} times)", times)));
  for (const std::string& line : lines) {
    log.info(line);
    if (!quiet) say("{}\n", line);
  }
}

/// The run itself, once its directory is open.
template <int D>
int run_recorded(Epochs<D>& epochs, const RunRequest& request, const Provenance& origin,
                 const std::optional<Restart>& restart, const Interruption& interruption, Real stop,
                 const RunDirectory& directory, RunLog& log) {
  const bool in_place = restart && restart->in_place;
  const State& begin = epochs.simulation().state();
  if (in_place) {  // before rows and frames are dropped that a later checkpoint would need
    const Snapshot snapshot = epochs.simulation().snapshot_of_first_rank();
    on_first_rank(
        [&] { CheckpointWriter(directory, origin).write(begin.step, begin.time, snapshot); });
  }
  Recorder<D> recorder(epochs.simulation(), directory, origin, in_place);
  Progress progress(begin, stop,
                    {epochs.scene().units.symbol(dimension::time),
                     epochs.scene().symbol_of_sum(dimension::energy),
                     !epochs.simulation().stepper().residuals(begin).empty()},
                    Progress::for_stdout(request.quiet),
                    [&log](const std::string& line) { log.info(line); });
  const std::int64_t first_step = begin.step;
  const double set_up_seconds = interruption.elapsed_seconds();
  bool has_begun = restart.has_value();
  std::optional<int> signal;
  try {
    epochs.simulation().stop_when([&] { return interruption.requested().has_value(); });
    if (!restart) {
      epochs.simulation().settle();
      recorder.record(-1);
      has_begun = true;
    }
    signal = run_steps(epochs, recorder, log, interruption, progress, stop);
  } catch (const Interrupted&) {
    signal = interruption.requested();
  } catch (const SolveError& e) {
    progress.finish();
    log.error(e.what());
    if (!ranks().all_come()) {  // nothing more that all have to do together
      keep_complaint(e.what());
      return exit_numerical;
    }
    repeat_warnings(request.quiet, log);
    recorder.write_last_good_frame();
    return exit_numerical;
  }
  progress.finish();
  if (!has_begun) {
    log.warning(fmt::format("stopped by {} before the first state was found: nothing to continue",
                            name_of(signal.value())));
    return exit_signal + *signal;
  }
  recorder.checkpoint();

  Simulation<D>& simulation = epochs.simulation();
  const std::string summary = summarise(simulation, first_step, set_up_seconds, interruption);
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
  say_how_to_continue(simulation, *signal, directory, log);
  return exit_signal + *signal;
}

/// The first rank has the directory, as soon as all have read what they continue from.
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

/// Of all nodes of all bodies: it tells whether all ranks have read the same meshes.
template <int D>
std::string mark_of_places(const Plan<D>& plan) {
  Fnv1a hash;
  for (const BodyPlan<D>& body : plan.bodies)
    for (const Vec<D>& X : body.geometry.grid.X)
      hash.add({reinterpret_cast<const char*>(X.data()), sizeof(Real) * D});
  return fmt::format("{:016x}", hash.value());
}

template <int D>
int run_scene(const SceneInput& input, const RunRequest& request) {
  Interruption interruption(request.max_walltime);
  Plan<D> plan = set_up(input, [&] { return read_plan<D>(input); });
  require_alike(mark_of_places(plan), "mesh");
  const std::string complete = input.complete();
  constexpr Real of_rounding = 1e-9;  // eight steps of 0.1 s come to 0.7999999999999999 s
  const Real until = time_to_stop(request, plan.units),
             stop = until < plan.time.end ? until * (1 - of_rounding) : plan.time.end;
  const std::optional<Restart> restart = read_restart(request, complete);
  const Snapshot* state = restart ? &restart->from.checkpoint.state : nullptr;

  const auto epochs =
      set_up(input, [&] { return std::make_unique<Epochs<D>>(std::move(plan), state); });
  require_known_outputs(input, epochs->scene());
  if (!restart) set_up(input, [&] { epochs->simulation().begin(); });

  interruption.catch_signals();  // before this nothing is lost by ending at once
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
    return run_recorded(*epochs, request, origin, restart, interruption, stop, *directory, log);
  } catch (const FileError& e) {
    log.error(e.what());
    keep_complaint(e.what());
    return exit_file;
  }
}

}  // namespace

int run(const RunRequest& request) {
  if (request.threads > 0) omp_set_num_threads(request.threads);
  std::optional<SceneInput> read;
  on_each_rank([&] { read.emplace(SceneInput::from_file(request.scene, request.set)); });
  const SceneInput& input = *read;
  require_alike(input.text(), fmt::format("scene '{}'", request.scene));
  return scene_dimension(input) == 2 ? run_scene<2>(input, request) : run_scene<3>(input, request);
}

}  // namespace meniscus
