// SPDX-License-Identifier: BSD-3-Clause
// Calls another program, or this program again, as a process of its own.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

struct ChildEnd {
  int exit_code;       ///< exit code, or 128 + n if signal n ended the process
  std::string output;  ///< text that it wrote to stdout
};

/// Calls a program and waits for its end. While the object lives, signals that ask this process to
/// stop are passed on to the called program and do not end this process. If there was such a
/// signal, this remains so when the object is destroyed. Only one object may exist at a time.
class Child {
 public:
  Child();
  ~Child();
  Child(const Child&) = delete;

  /// Calls this program and captures its stdout. Throws FileError if it cannot be started.
  ChildEnd call(const std::vector<std::string>& arguments);
  /// Calls a program that writes its own output. `argv` ends with a null pointer. Returns the
  /// status that waitpid() gives. Throws FileError if it cannot be started.
  int call(const std::string& program, char** argv);
  /// The first signal that was passed on, or that arrived between two calls.
  std::optional<int> signal() const;
};

}  // namespace meniscus
