// SPDX-License-Identifier: BSD-3-Clause
// Summaries of result files, for `meniscus info`.
#pragma once
#include <filesystem>
#include <string>

namespace meniscus {

/// Describes a file as text. For a result file, or all result files in the directory of a run:
/// program, bodies, fields with units, frames with times. For a checkpoint: program, step, arrays.
/// Throws FileError if the file is neither.
std::string describe_file(const std::filesystem::path& path);

}  // namespace meniscus
