// SPDX-License-Identifier: BSD-3-Clause
// Exceptions; app maps each kind to its exit code.
#pragma once
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace meniscus {

/// The input is wrong (exit code 3). what() has one line per problem:
///
///   file:line:column: key: the problem; allowed values; did you mean
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The calculation cannot go on (exit code 4): singular moment matrix, J <= 0, NaN, or a time step
/// that became too small. what() names body, particle, place and cause.
struct SolveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Description of a step that failed. The force term sets cause and particle, the system sets body
/// and place, and the run sets step and time. StepError::what() is text().
struct StepFailure {
  std::string cause;     ///< e.g. "J = -0.3 at a stress point; F = [...]"
  std::string term;      ///< name of the force term; empty if there is none
  std::string body;      ///< empty if the failure has no place
  int particle = -1;     ///< particle number over all bodies
  std::string place;     ///< "(0, 1), now (0.1, 1.2)": reference and current position
  bool of_step = false;  ///< a shorter step may avoid it
  int halvings = 0;      ///< how often the step was halved before the run gave up
  std::int64_t step = -1;
  double time = 0, dt = 0;  ///< at the end of the step, and its length

  std::string text() const;
};
struct StepError : SolveError {
  explicit StepError(StepFailure f) : SolveError(f.text()), failure(std::move(f)) {}
  StepFailure failure;
};

/// Thrown if a long step is asked to stop. This is no error.
struct Interrupted : std::exception {
  const char* what() const noexcept override { return "the step was interrupted"; }
};

/// A file cannot be read or written, or would be overwritten (exit code 5).
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace meniscus
