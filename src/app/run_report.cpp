// SPDX-License-Identifier: BSD-3-Clause
// Lines of the log about a run.
#include "app/run_report.hpp"

#include "app/print.hpp"
#include "io/history.hpp"
#include "measure/drop_measures.hpp"
#include "parallel/memory.hpp"
#include "parallel/ranks.hpp"
#include "physics/contact/pair/contact_visits.hpp"
#include "scene/expectations.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <csignal>
#include <sstream>

namespace meniscus {
namespace {

/// Hash of the state without the audit. The audit remembers energies seen when rows of the history
/// were written; how often rows are written must not change the hash.
std::uint64_t hash_of_state(const Snapshot& snapshot) {
  Snapshot state;
  for (const auto& [name, array] : snapshot.arrays())
    if (!name.starts_with("audit/")) state.add(name, array);
  return state.hash();
}

/// Logs whether the final state is stable. Returns false if it is unstable.
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

}  // namespace

template <int D>
int report_expectations(const Simulation<D>& simulation, const RunDirectory& directory,
                        RunLog& log) {
  auto expectations = simulation.scene().expectations;
  if (expectations.empty()) return exit_ok;
  Real end = simulation.scene().time.end;
  if (simulation.finished()) {  // bodies at rest do not change any more
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
  if (stable.dt > 0)  // the stable step was estimated
    log.info(fmt::format("stable step {:.6g} {}", stable.dt, scene.units.symbol(dimension::time)));
}

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
                         capillary_residual(force, tension.gamma, tension.area(state.motion()),
                                            tension.volume(state.motion()), body.space())));
  }
}

template <int D>
std::string summarise(Simulation<D>& simulation, std::int64_t first_step,
                      const RunSeconds& seconds) {
  const std::int64_t steps = simulation.state().step - first_step;
  const Real particle_steps =
      static_cast<Real>(std::max<std::int64_t>(1, steps)) * simulation.scene().system.size();
  const std::string effort = simulation.stepper().effort();
  return fmt::format(
      "{} steps in {:.2f} s ({:.0f} ns per particle-step{}{}), set-up {:.2f} s, state {:016x}",
      steps, seconds.steps, 1e9 * seconds.steps / particle_steps, effort.empty() ? "" : ", ",
      effort, seconds.set_up, hash_of_state(simulation.snapshot_of_first_rank()));
}

template <int D>
void report_ranks(const System<D>& system, std::int64_t steps, RunLog& log) {
  if (ranks().alone()) return;
  log.info(system.followed.halo()
               ? fmt::format("a rank makes its steps on {} of {} particles at most, {} of them "
                             "ghosts",
                             ranks().largest(system.followed.halo()->size()), system.size(),
                             ranks().largest(system.followed.halo()->ghosts()))
               : "all ranks make their steps on all particles because of " +
                     system.followed.reason());
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
  // newton with fluids arrives at time.end, too, where loads that still change keep them in motion.
  const bool within = std::all_of(residuals.begin(), residuals.end(), [](const Residual& r) {
    return !r.allowed || r.value <= *r.allowed;
  });
  if (rest && within)
    log.info(fmt::format("at rest at {}: {}", time, measures));
  else if (rest)
    log.info(
        fmt::format("loads change until the end at {}, where bodies need not be at rest: {}; "
                    "loads that are steady long before time.end let them come to rest",
                    time, measures));
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
void say_how_to_continue(const Simulation<D>& simulation, int signal, const std::string& directory,
                         RunLog& log) {
  log.warning(fmt::format(
      "stopped after step {}, t = {:.9g} {}, by {}; to continue, run the same command with "
      "--restart {}",
      simulation.state().step, simulation.state().time,
      simulation.scene().units.symbol(dimension::time), name_of(signal), directory));
}

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

#define MENISCUS_INSTANTIATE(D)                                                              \
  template void introduce(const Scene<D>&, const Provenance&, const std::optional<Restart>&, \
                          const StableStep&, RunLog&);                                       \
  template void report_residuals(const Simulation<D>&, RunLog&);                             \
  template std::string summarise(Simulation<D>&, std::int64_t, const RunSeconds&);           \
  template void report_contacts(const System<D>&, RunLog&);                                  \
  template void report_ranks(const System<D>&, std::int64_t, RunLog&);                       \
  template bool report_rest(Simulation<D>&, RunLog&);                                        \
  template int report_expectations(const Simulation<D>&, const RunDirectory&, RunLog&);      \
  template void say_how_to_continue(const Simulation<D>&, int, const std::string&, RunLog&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
