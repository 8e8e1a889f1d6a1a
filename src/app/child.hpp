// SPDX-License-Identifier: BSD-3-Clause
// Calls other programs, or this program again, as processes of their own.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

struct ChildEnd {
  int exit_code;       ///< exit code, or 128 + n if signal n ended the process
  std::string output;  ///< text that it wrote to stdout
};

/// Calls programs and waits for their ends. While the object lives, signals that ask this process
/// to stop are passed on to the called programs and do not end this process. If there was such a
/// signal, this remains so when the object is destroyed. Only one object may exist at a time.
class Children {
 public:
  static constexpr int most = 256;  ///< that run at the same time

  Children();
  ~Children();
  Children(const Children&) = delete;

  /// Starts this program, whose stdout is captured; returns the number of the process. Throws
  /// FileError if it cannot be started.
  int start(const std::vector<std::string>& arguments);
  /// Waits until one of the started programs ends; returns the number of its process, and its end.
  std::pair<int, ChildEnd> next();
  /// Calls a program that writes its own output. `argv` ends with a null pointer. Returns the
  /// status that waitpid() gives. Throws FileError if it cannot be started.
  int call(const std::string& program, char** argv);
  /// The first signal that was passed on, or that arrived between two calls.
  std::optional<int> signal() const;

 private:
  std::vector<std::pair<int, int>> outputs_;  ///< number of a process, and the file that it writes
};

}  // namespace meniscus
