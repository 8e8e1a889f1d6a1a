// SPDX-License-Identifier: BSD-3-Clause
// Progress of a run: how far it is, how fast it goes, and how long it may still take.
#pragma once
#include "solve/audit.hpp"

#include <deque>
#include <functional>
#include <optional>
#include <string>

namespace meniscus {

/// How fast a run goes, over its last minute and its last ten steps at least.
class Pace {
 public:
  /// The run begins, `seconds` after any beginning of wall time.
  Pace(double seconds, const State& begin) : marks_{{seconds, begin.time, begin.step}} {}

  /// A step of `dt` has ended at `state`.
  void add(double seconds, const State& state, Real dt);
  double seconds_of_last_step() const { return last_step_seconds_; }
  double steps_per_second() const;
  /// Seconds until `end` if it goes on like this; none while too few steps have been made, and
  /// while the step is another than it was: then nobody can tell.
  std::optional<double> seconds_to(Real end) const;

 private:
  struct Mark {
    double seconds;
    Real time;
    std::int64_t step;
  };
  double seconds_since_first_mark() const { return now_.seconds - marks_.front().seconds; }
  std::int64_t steps_since_first_mark() const { return now_.step - marks_.front().step; }

  std::deque<Mark> marks_;
  Mark now_ = marks_.front();
  Real dt_ = 0;
  double last_step_seconds_ = 0;
};

/// On a terminal it is one line that is written over twice a second; elsewhere and in the log there
/// is a line after ten seconds and then one every minute.
class Progress {
 public:
  enum class Shown { on_terminal, in_lines, in_log_only };
  struct Text {
    std::string time_unit, energy_unit;
    bool may_end_earlier = false;  ///< at rest, say
  };
  using Seconds = std::function<double()>;

  /// The run begins now, at `begin`, and is meant to reach the time `end`. `log` gets lines;
  /// `seconds` is wall time.
  Progress(const State& begin, Real end, Text text, Shown shown,
           std::function<void(const std::string&)> log, Seconds seconds = wall_time);
  /// After each step. `ledger`: the newest one, if there is a new one.
  void show(const State& state, Real dt, const std::optional<Ledger>& ledger);
  /// Makes place on the terminal for something else.
  void finish();

  /// How stdout wants it.
  static Shown for_stdout(bool quiet);
  static double wall_time();

 private:
  std::string line(const State& state, Real dt) const;

  Real end_;
  Text text_;
  Shown shown_;
  std::function<void(const std::string&)> log_;
  Seconds seconds_;
  double next_on_terminal_, next_line_;
  Pace pace_;
  std::optional<Ledger> ledger_;  ///< none before the first row of the history
};

}  // namespace meniscus
