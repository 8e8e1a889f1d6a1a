// SPDX-License-Identifier: BSD-3-Clause
// Log of a run: everything to run.log, warnings and errors also to stderr.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meniscus {

/// The log of a run in its results directory.
class RunLog {
 public:
  /// A log on stderr alone (for what happens before there is a directory, and for tests).
  RunLog();
  /// Appends to `file`, each line with its time (UTC) and level, written at once. Throws FileError.
  explicit RunLog(const std::filesystem::path& file);
  /// Nothing but the list of warnings.
  static RunLog silent();
  ~RunLog();
  RunLog(RunLog&&) noexcept;
  RunLog& operator=(RunLog&&) noexcept;

  void info(std::string_view message);
  void warning(std::string_view message);
  void error(std::string_view message);

  /// The warnings so far in the order of their first time, each text once with how often it came.
  const std::vector<std::pair<std::string, int>>& warnings() const;

 private:
  struct Logger;
  explicit RunLog(std::unique_ptr<Logger> logger);
  std::unique_ptr<Logger> logger_;
};

}  // namespace meniscus
