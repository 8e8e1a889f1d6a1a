// SPDX-License-Identifier: BSD-3-Clause
// Errors; app maps each kind to its exit code.
#pragma once
#include <stdexcept>
#include <string>

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

/// A file cannot be read or written, or would be overwritten (exit code 5).
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace meniscus
