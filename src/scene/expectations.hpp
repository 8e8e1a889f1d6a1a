// SPDX-License-Identifier: BSD-3-Clause
// Expectations of a scene, compared with the history of its run.
#pragma once
#include "scene/settings.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

/// The history by column; throws FileError for a name it does not have.
using HistoryColumns = std::function<const std::vector<Real>&(const std::string&)>;

/// What became of an expectation.
struct ExpectationResult {
  std::string name;
  Real obtained = 0;                 ///< not a number if the history holds too few rows to tell
  Real expected = 0, tolerance = 0;  ///< tolerance is absolute
  bool reached = true;  ///< false: the history does not cover the times the expectation is about
  bool met = false;
};

/// Evaluates all expectations; `end` is that of the scene.
std::vector<ExpectationResult> evaluate_expectations(
    const std::vector<std::pair<std::string, ExpectSettings>>& expectations,
    const HistoryColumns& history, Real end);

/// The results as a table of lines.
std::string expectation_table(const std::vector<ExpectationResult>& results);

}  // namespace meniscus
