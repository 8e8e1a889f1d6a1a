// SPDX-License-Identifier: BSD-3-Clause
// Log of a run. All messages go to run.log; warnings and errors also go to stderr.
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
  /// A log that writes to stderr only, for messages before the directory exists and for tests.
  RunLog();
  /// Appends to `file`. Each line has its time (UTC) and level and is written at once. Throws
  /// FileError.
  explicit RunLog(const std::filesystem::path& file);
  /// A log that writes nothing and only collects warnings.
  static RunLog silent();
  ~RunLog();
  RunLog(RunLog&&) noexcept;
  RunLog& operator=(RunLog&&) noexcept;

  void info(std::string_view message);
  void warning(std::string_view message);
  void error(std::string_view message);

  /// All different warnings with the number of times each was logged, in the order of their first
  /// time.
  const std::vector<std::pair<std::string, int>>& warnings() const;

 private:
  struct Logger;
  explicit RunLog(std::unique_ptr<Logger> logger);
  std::unique_ptr<Logger> logger_;
};

}  // namespace meniscus
