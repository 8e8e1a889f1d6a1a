// SPDX-License-Identifier: BSD-3-Clause
// Progress on one line of a terminal.
#include "meniscus/app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace meniscus {

Progress::Progress(Real begin, Real end, std::string time_unit, std::string energy_unit, bool quiet)
    : begin_(begin),
      end_(end),
      time_unit_(std::move(time_unit)),
      energy_unit_(std::move(energy_unit)),
      on_(!quiet && isatty(STDOUT_FILENO)) {}

void Progress::show(const State& state, Real dt, const std::optional<Ledger>& ledger,
                    double elapsed_seconds) {
  if (!on_) return;
  if (first_step_ < 0) first_step_ = state.step;
  if (ledger) ledger_ = *ledger;
  if (elapsed_seconds - last_shown_ < 0.5) return;
  last_shown_ = elapsed_seconds;
  const Real done = (state.time - begin_) / (end_ - begin_);
  const Real rate = static_cast<Real>(state.step - first_step_) / std::max(elapsed_seconds, 1e-9);
  const Real eta = done > 0 ? elapsed_seconds * (1 - done) / done : 0;
  std::string energies = fmt::format("kinetic {:.3g}", ledger_.kinetic);
  for (const auto& [kind, energy] : ledger_.stored) energies += fmt::format(", {} {:.3g}", kind, energy);
  fmt::print("\r\033[Kstep {}  t {:.4g} {}  dt {:.3g}  {:.1f} %  ETA {:.0f} s  {:.0f} steps/s  {} {}",
             state.step, state.time, time_unit_, dt, 100 * done, eta, rate, energies, energy_unit_);
  std::fflush(stdout);
}

void Progress::finish() {
  if (on_) fmt::print("\r\033[K");
  std::fflush(stdout);
}

}  // namespace meniscus
