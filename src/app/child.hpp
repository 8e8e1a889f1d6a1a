// SPDX-License-Identifier: BSD-3-Clause
// This program called by itself, or one that lies beside it, in a process of its own.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

struct ChildEnd {
  int exit_code;       ///< 128 + n if signal n ended it
  std::string output;  ///< what it wrote to stdout
};

/// Calls a program and waits for its end. While the object lives, signals that ask to stop are
/// handed on to it; once one was, others change nothing any more. One object at a time.
class Child {
 public:
  Child();
  ~Child();
  Child(const Child&) = delete;

  /// Calls this program. Throws FileError if it cannot be started.
  ChildEnd call(const std::vector<std::string>& arguments);
  /// Calls a program that speaks for itself, with a null after its arguments; returns what waitpid
  /// says of its end. Throws FileError.
  int call(const std::string& program, char** argv);
  /// The first signal that was handed on, or came between two calls.
  std::optional<int> signal() const;
};

}  // namespace meniscus
