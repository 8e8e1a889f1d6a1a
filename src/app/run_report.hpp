// SPDX-License-Identifier: BSD-3-Clause
// Lines of the log about a run: at its beginning and at its end.
#pragma once
#include "app/commands.hpp"
#include "app/restart.hpp"
#include "io/provenance.hpp"
#include "io/run_log.hpp"
#include "run/simulation.hpp"

#include <optional>
#include <string>

namespace meniscus {

template <int D>
void introduce(const Scene<D>& scene, const Provenance& origin,
               const std::optional<Restart>& restart, const StableStep& stable, RunLog& log);
/// Logs how far the drops are from equilibrium at the start.
template <int D>
void report_residuals(const Simulation<D>& simulation, RunLog& log);
/// Wall-clock time of a run.
struct RunSeconds {
  double set_up, steps;
};
/// Steps, time and state hash of a run that has made its steps since `first_step`.
template <int D>
std::string summarise(Simulation<D>& simulation, std::int64_t first_step,
                      const RunSeconds& seconds);
/// Logs the pairs of contact points visited per force, and for comparison the pairs of points and
/// particles of all other terms.
template <int D>
void report_contacts(const System<D>& system, RunLog& log);
/// Logs the messages, the particles and the memory of the ranks since the start of the run.
template <int D>
void report_ranks(const System<D>& system, std::int64_t steps, RunLog& log);
/// Logs whether the bodies are at rest in a stable state. Returns false if they should be but are
/// not.
template <int D>
bool report_rest(Simulation<D>& simulation, RunLog& log);
/// The expectations of the scene beside its results; returns the exit code.
template <int D>
int report_expectations(const Simulation<D>& simulation, const RunDirectory& directory,
                        RunLog& log);

std::string name_of(int signal);
template <int D>
void say_how_to_continue(const Simulation<D>& simulation, int signal, const std::string& directory,
                         RunLog& log);
/// Logs all warnings of the run once more at the end, where they are easy to find.
void repeat_warnings(bool quiet, RunLog& log);

}  // namespace meniscus
