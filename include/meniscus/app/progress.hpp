// SPDX-License-Identifier: BSD-3-Clause
// Progress of a run on one line of the terminal.
#pragma once
#include "meniscus/solve/audit.hpp"

#include <chrono>

namespace meniscus {

/// Prints at most twice a second, and nothing at all when stdout is not a terminal.
class Progress {
 public:
  /// The run begins now, at `begin`, and is meant to reach the time `end`.
  Progress(const State& begin, Real end, std::string time_unit, std::string energy_unit,
           bool quiet);
  /// `ledger`: the newest one, if there is a new one.
  void show(const State& state, Real dt, const std::optional<Ledger>& ledger);
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  Real first_time_, end_;
  std::int64_t first_step_;
  std::string time_unit_, energy_unit_;
  bool on_;
  Clock::time_point begin_ = Clock::now(), last_shown_ = begin_;
  Ledger ledger_;
};

}  // namespace meniscus
