// SPDX-License-Identifier: BSD-3-Clause
// Shows the progress of a run: on one line of a terminal, or as separate lines in a file.
#include "app/progress.hpp"

#include "app/print.hpp"
#include "parallel/ranks.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace meniscus {
namespace {

constexpr double seconds_on_terminal = 0.5, seconds_to_first_line = 10, seconds_of_line = 60;

/// A duration for people: "40 s", "3 min", "5.2 h".
std::string duration(double seconds) {
  constexpr double minute = 60, hour = 3600, day = 86400;
  if (seconds < 100) return fmt::format("{:.0f} s", seconds);
  if (seconds < 100 * minute) return fmt::format("{:.0f} min", seconds / minute);
  if (seconds < 2 * day) return fmt::format("{:.1f} h", seconds / hour);
  return fmt::format("{:.1f} days", seconds / day);
}

}  // namespace

void Pace::add(double seconds, const State& state, Real dt) {
  constexpr double seconds_between_marks = 5, seconds_of_memory = 60;
  constexpr std::int64_t least_steps = 10;
  last_step_seconds_ = seconds - now_.seconds;
  dt_ = dt;
  now_ = {seconds, state.time, state.step};
  // The oldest mark can go once the next one is old enough to measure the pace.
  while (marks_.size() > 1 && seconds - marks_[1].seconds >= seconds_of_memory &&
         state.step - marks_[1].step >= least_steps)
    marks_.pop_front();
  if (seconds - marks_.back().seconds >= seconds_between_marks) marks_.push_back(now_);
}

double Pace::steps_per_second() const {
  return static_cast<double>(steps_since_first_mark()) / std::max(1e-9, seconds_since_first_mark());
}

std::optional<double> Pace::seconds_to(Real end) const {
  constexpr std::int64_t least_steps = 10;
  constexpr Real alike = 1.5;
  const auto steps = static_cast<Real>(steps_since_first_mark());
  const Real way = now_.time - marks_.front().time;
  if (steps < least_steps || !(way > 0)) return std::nullopt;
  const Real usual = way / steps;
  if (dt_ * alike < usual || dt_ > alike * usual) return std::nullopt;
  return (end - now_.time) / way * seconds_since_first_mark();
}

Progress::Progress(const State& begin, Real end, Text text, Shown shown,
                   std::function<void(const std::string&)> log, Seconds seconds)
    : end_(end),
      text_(std::move(text)),
      shown_(shown),
      log_(std::move(log)),
      seconds_(std::move(seconds)),
      next_on_terminal_(seconds_() + seconds_on_terminal),
      next_line_(next_on_terminal_ - seconds_on_terminal + seconds_to_first_line),
      pace_(next_on_terminal_ - seconds_on_terminal, begin) {}

void Progress::show(const State& state, Real dt, const std::optional<Ledger>& ledger) {
  if (ledger) ledger_ = ledger;
  const double now = seconds_();
  pace_.add(now, state, dt);
  write(now, [&] { return line(state, dt); });
}

void Progress::within(const State& state, Real dt, const std::string& doing) {
  if (doing.empty()) return;
  write(seconds_(), [&] {
    return fmt::format("step {} to t = {:.4g} of {:.4g} {}: {}", state.step + 1, state.time + dt,
                       end_, text_.time_unit, doing);
  });
}

void Progress::write(double now, const std::function<std::string()>& text) {
  if (now >= next_line_) {
    next_line_ = now + seconds_of_line;
    const std::string written = text();
    log_(written);
    if (shown_ == Shown::in_lines) {
      say("{}\n", written);
      std::fflush(stdout);
    }
  }
  if (shown_ == Shown::on_terminal && now >= next_on_terminal_) {
    next_on_terminal_ = now + seconds_on_terminal;
    print_over_line(text());
    std::fflush(stdout);
  }
}

std::string Progress::line(const State& state, Real dt) const {
  const auto left = pace_.seconds_to(end_);
  const std::string duration_left =
      left ? fmt::format("{} {} left", text_.may_end_earlier ? "at most" : "about", duration(*left))
           : "time left unknown";
  const double rate = pace_.steps_per_second();
  std::string speed = fmt::format("{:.3g} steps/s", rate);
  if (rate < 1)
    speed = fmt::format("{} per step, the last took {}", duration(1 / rate),
                        duration(pace_.seconds_of_last_step()));
  std::string energies;
  if (ledger_) {
    energies = fmt::format("; kinetic {:.3g}", ledger_->kinetic);
    for (const auto& [kind, energy] : ledger_->stored)
      energies += fmt::format(", {} {:.3g}", kind, energy);
    energies += " " + text_.energy_unit;
  }
  return fmt::format("step {}, t = {:.4g} of {:.4g} {} ({:.1f} %), dt = {:.3g}, {}, {}{}",
                     state.step, state.time, end_, text_.time_unit, 100 * state.time / end_, dt,
                     speed, duration_left, energies);
}

void Progress::finish() {
  if (shown_ == Shown::on_terminal) print_over_line("");
  std::fflush(stdout);
}

Progress::Shown Progress::for_stdout(bool quiet) {
  if (quiet) return Shown::in_log_only;
  // With mpirun, the streams of the ranks look like terminals but are read by mpirun.
  return launch().size == 1 && isatty(STDOUT_FILENO) ? Shown::on_terminal : Shown::in_lines;
}

double Progress::wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace meniscus
