// SPDX-License-Identifier: BSD-3-Clause
// Interruption of a run: signals and a limit on wall-clock time.
#pragma once
#include <chrono>
#include <optional>
#include <string>

namespace meniscus {

/// Notes SIGINT, SIGTERM, SIGHUP, SIGUSR1 and SIGXCPU. The run stops at the end of the current
/// step; Newton's method also stops within a step. Another signal more than a second later ends the
/// program at once. This remains so after the object is destroyed. Only one object may exist at a
/// time.
class Interruption {
 public:
  /// The run may take `max_walltime` seconds from now.
  explicit Interruption(std::optional<double> max_walltime);
  ~Interruption();
  Interruption(const Interruption&) = delete;

  /// Starts to note signals. Signals that the program was started to ignore (nohup) remain ignored.
  void catch_signals();

  /// Number of the signal for which this process should stop; SIGALRM (14) when the time is up.
  std::optional<int> noticed() const;
  /// Like noticed(), for all ranks together: all return the same signal. All ranks call this.
  std::optional<int> requested() const;
  double elapsed_seconds() const;

 private:
  std::chrono::steady_clock::time_point begin_;
  double limit_seconds_;
};

/// Seconds of "H:M:S", "M:S" or "S". Empty if the text has another form or is not positive.
std::optional<double> parse_duration(const std::string& text);

}  // namespace meniscus
