// SPDX-License-Identifier: BSD-3-Clause
// What a scene expects of its own result, held against the history of the run.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "meniscus/scene/settings.hpp"

namespace meniscus {

/// The history by column; throws FileError for a name it does not have.
using HistoryColumns = std::function<const std::vector<Real>&(const std::string&)>;

struct ExpectationResult {
  std::string name;
  Real obtained = 0, expected = 0, tolerance = 0;  ///< tolerance is absolute
  bool reached = true;  ///< false: the run ended before the times the expectation is about
  bool met = false;
};

/// Evaluates all expectations. `stopped_early`: the run was told to end before the scene's end, so
/// expectations about "the end" are not reached.
std::vector<ExpectationResult> evaluate_expectations(
    const std::vector<std::pair<std::string, ExpectSettings>>& expectations,
    const HistoryColumns& history, bool stopped_early);

/// The results as a table of lines.
std::string expectation_table(const std::vector<ExpectationResult>& results);

}  // namespace meniscus
