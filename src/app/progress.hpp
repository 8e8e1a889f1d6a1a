// SPDX-License-Identifier: BSD-3-Clause
// Progress of a run: the time reached, the speed, and an estimate of the remaining time.
#pragma once
#include "solve/audit.hpp"

#include <deque>
#include <functional>
#include <optional>
#include <string>

namespace meniscus {

/// Speed of a run, averaged over at least its last minute and its last ten steps.
class Pace {
 public:
  /// Starts at the state `begin`. `seconds` is the wall-clock time, counted from any origin.
  Pace(double seconds, const State& begin) : marks_{{seconds, begin.time, begin.step}} {}

  /// Records a step of size `dt` that ended at `state`.
  void add(double seconds, const State& state, Real dt);
  double seconds_of_last_step() const { return last_step_seconds_; }
  double steps_per_second() const;
  /// Estimated seconds until the time `end` at the present speed. Empty after too few steps, and
  /// while the step size changes, since no estimate is then reliable.
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

/// Shows the progress of a run. On a terminal, one line is overwritten twice a second. Otherwise,
/// and in the log, a line is written after ten seconds and then every minute.
class Progress {
 public:
  enum class Shown { on_terminal, in_lines, in_log_only };
  struct Text {
    std::string time_unit, energy_unit;
    bool may_end_earlier = false;  ///< e.g. because a state of rest is reached
  };
  using Seconds = std::function<double()>;

  /// The run starts now at `begin` and is to reach the time `end`. `log` receives lines; `seconds`
  /// returns the wall-clock time.
  Progress(const State& begin, Real end, Text text, Shown shown,
           std::function<void(const std::string&)> log, Seconds seconds = wall_time);
  /// Call this after each step. `ledger`: the newest ledger if this step wrote one.
  void show(const State& state, Real dt, const std::optional<Ledger>& ledger);
  /// Call this now and then during a long step from `state`. `doing`: how far it has come.
  void within(const State& state, Real dt, const std::string& doing);
  /// Clears the line on the terminal, so that other text can be written.
  void finish();

  /// The way to show progress that suits stdout: terminal, file, or quiet.
  static Shown for_stdout(bool quiet);
  static double wall_time();

 private:
  std::string line(const State& state, Real dt) const;
  /// Writes a text where and if one is due.
  void write(double now, const std::function<std::string()>& text);

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
