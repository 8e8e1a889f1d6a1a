// SPDX-License-Identifier: BSD-3-Clause
// Errors; app maps each kind to its exit code.
#pragma once
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace meniscus {

/// The input is wrong (exit code 3). what() is the whole report, one line per problem, each
/// `file:line:column: key: what is wrong; allowed; did you mean`.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The calculation cannot go on (exit code 4): singular moment matrix, J <= 0, not a number, step
/// collapse. what() names body, particle, place and cause.
struct SolveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A step that cannot be made. What is known grows on the way up: a force term says particle and
/// cause, the system body and place, the run step and time. what() is the sentence of it all.
struct StepFailure {
  std::string cause;     ///< e.g. "J = -0.3 at a stress point; F = [...]"
  std::string term;      ///< name of the force term; empty if there is none
  std::string body;      ///< empty where the failure has no place
  int particle = -1;     ///< over all bodies
  std::string place;     ///< "(0, 1), now (0.1, 1.2)": in the reference state and at the time
  bool of_step = false;  ///< a shorter step may avoid it
  int halvings = 0;      ///< of the step, before it was given up
  std::int64_t step = -1;
  double time = 0, dt = 0;  ///< at the end of the step, and its length

  std::string text() const;
};
struct StepError : SolveError {
  explicit StepError(StepFailure f) : SolveError(f.text()), failure(std::move(f)) {}
  StepFailure failure;
};

/// A long step was asked to stop, which is no error.
struct Interrupted : std::exception {
  const char* what() const noexcept override { return "the step was interrupted"; }
};

/// A file cannot be read or written, or would be overwritten (exit code 5).
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace meniscus
