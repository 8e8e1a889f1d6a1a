// SPDX-License-Identifier: BSD-3-Clause
// Summaries of result files, for `meniscus info`.
#pragma once
#include <filesystem>
#include <string>

namespace meniscus {

/// Program, bodies, fields with units and frames with times of a result file (or of all in the
/// directory of a run), or program, step and arrays of a checkpoint, as text. Throws FileError if
/// it is neither.
std::string describe_file(const std::filesystem::path& path);

}  // namespace meniscus
