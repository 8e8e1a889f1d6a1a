// SPDX-License-Identifier: BSD-3-Clause
// Expectations of a scene, which are compared with the history of its run.
#pragma once
#include "scene/settings.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// Returns a column of the history by name; throws FileError if there is none.
using HistoryColumns = std::function<const std::vector<Real>&(const std::string&)>;

/// Result of an expectation.
struct ExpectationResult {
  std::string name;
  Real obtained = 0;                                  ///< NaN if the history has too few rows
  std::optional<Real> expected = {}, tolerance = {};  ///< absolute; without one it is reported only
  bool reached = true;  ///< false if the history does not cover the times of the expectation
  bool met = false;     ///< of a number that is reported only: it is one
};

/// Evaluates all expectations. `end` is the end time of the scene.
std::vector<ExpectationResult> evaluate_expectations(
    const std::vector<std::pair<std::string, ExpectSettings>>& expectations,
    const HistoryColumns& history, Real end);

/// The results as a table with one line per expectation.
std::string expectation_table(const std::vector<ExpectationResult>& results);

}  // namespace meniscus
