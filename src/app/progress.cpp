// SPDX-License-Identifier: BSD-3-Clause
// Progress on one line of a terminal.
#include "meniscus/app/progress.hpp"

#include "meniscus/app/print.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>

namespace meniscus {

Progress::Progress(const State& begin, Real end, std::string time_unit, std::string energy_unit,
                   bool quiet)
    : first_time_(begin.time),
      end_(end),
      first_step_(begin.step),
      time_unit_(std::move(time_unit)),
      energy_unit_(std::move(energy_unit)),
      on_(!quiet && isatty(STDOUT_FILENO)) {}

void Progress::show(const State& state, Real dt, const std::optional<Ledger>& ledger) {
  if (!on_) return;
  if (ledger) ledger_ = *ledger;
  const Clock::time_point now = Clock::now();
  if (now - last_shown_ < std::chrono::milliseconds(500)) return;
  last_shown_ = now;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const Real done = (state.time - first_time_) / (end_ - first_time_);
  const Real rate = static_cast<Real>(state.step - first_step_) / seconds;
  std::string energies = fmt::format("kinetic {:.3g}", ledger_.kinetic);
  for (const auto& [kind, energy] : ledger_.stored)
    energies += fmt::format(", {} {:.3g}", kind, energy);
  say("\r\033[Kstep {}  t {:.4g} {}  dt {:.3g}  {:.1f} %  ETA {:.0f} s  {:.0f} steps/s  {} {}",
      state.step, state.time, time_unit_, dt, 100 * done, seconds * (1 - done) / done, rate,
      energies, energy_unit_);
  std::fflush(stdout);
}

void Progress::finish() {
  if (on_) say("\r\033[K");
  std::fflush(stdout);
}

}  // namespace meniscus
