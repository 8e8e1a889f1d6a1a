// SPDX-License-Identifier: BSD-3-Clause
// The phases of a force: each process computes its rows; numbers that terms need of all rows are
// gathered; terms continue with these numbers. At the end, sums of chunks are exchanged and added
// to the forces.
#pragma once
#include "meniscus/physics/force_term.hpp"

#include <exception>
#include <functional>
#include <vector>

namespace meniscus {

class ForcePhases {
 public:
  /// Completes a motion that is known at followed particles only.
  using Everywhere = std::function<Motion(const Motion&)>;

  /// Begins the forces at a motion. Returns `force` for the terms. If `everywhere` is null, the
  /// motion is complete. All processes call this.
  Forces begin(const Motion& motion, Forces force, const Everywhere* everywhere);
  /// Runs the first phase of a term: work() returns a report, which is added to `report`. The
  /// report must not move until finish().
  template <class F>
  void run(Report& report, F&& work) {
    report_ = &report;
    try {
      report += work();
    } catch (...) {
      fail();
    }
  }
  /// Runs the other phases of all terms and adds the sums of chunks. All processes call this.
  /// Throws on all what a phase has thrown on one; the last phase of a term, which works with
  /// gathered numbers alone, throws on all or on none.
  void finish();

  // For Forces.
  void later(std::span<const Gathered> arrays, Forces::Then then);
  Motion everywhere();

 private:
  struct Waiting {
    Report* report;
    Forces::Then then;
  };
  /// Keeps the first exception until the next exchange.
  void fail();

  Motion motion_{};
  Forces force_{std::span<NodalVector>()};
  const Everywhere* everywhere_ = nullptr;
  Report* report_ = nullptr;
  std::vector<Waiting> waiting_, now_;
  std::vector<Gathered> gathered_;
  GatherTogether gather_;
  PendingSums sums_;
  std::exception_ptr failure_;
};

/// The failure of the first process that knows the particle. All processes call this.
Failure shared(Failure failure);

}  // namespace meniscus
