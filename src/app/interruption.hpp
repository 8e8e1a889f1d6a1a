// SPDX-License-Identifier: BSD-3-Clause
// Interruption of a run: signals and a limit on wall-clock time.
#pragma once
#include <chrono>
#include <optional>
#include <string>

namespace meniscus {

/// SIGINT, SIGTERM, SIGHUP, SIGUSR1 and SIGXCPU are noted and acted on at the end of the step, of
/// Newton's method within it; another one a second later ends the program at once, and so it stays
/// when the object is gone. One object at a time.
class Interruption {
 public:
  /// `max_walltime` in seconds from now.
  explicit Interruption(std::optional<double> max_walltime);
  ~Interruption();
  Interruption(const Interruption&) = delete;

  /// From now on signals are noted, but for those the program was started to ignore (nohup).
  void catch_signals();

  /// Number of the signal to stop for; SIGALRM (14) when the time is up.
  std::optional<int> noticed() const;
  /// The same of all ranks, which ask together.
  std::optional<int> requested() const;
  double elapsed_seconds() const;

 private:
  std::chrono::steady_clock::time_point begin_;
  double limit_seconds_;
};

/// Seconds of "H:M:S", "M:S" or "S"; nothing if the text is none of these or not positive.
std::optional<double> parse_duration(const std::string& text);

}  // namespace meniscus
