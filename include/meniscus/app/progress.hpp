// SPDX-License-Identifier: BSD-3-Clause
// The line that tells a person how far a run is.
#pragma once
#include "meniscus/solve/audit.hpp"

namespace meniscus {

/// Prints at most twice a second, and nothing at all when stdout is not a terminal.
class Progress {
 public:
  Progress(Real begin, Real end, std::string time_unit, std::string energy_unit, bool quiet);
  void show(const State& state, Real dt, const std::optional<Ledger>& ledger, double elapsed_seconds);
  void finish();

 private:
  Real begin_, end_;
  std::string time_unit_, energy_unit_;
  bool on_;
  double last_shown_ = -1;
  std::int64_t first_step_ = -1;
  Ledger ledger_;
};

}  // namespace meniscus
