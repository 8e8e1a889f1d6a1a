// SPDX-License-Identifier: BSD-3-Clause
// Commands that are separate programs.
#pragma once
#include <filesystem>
#include <string>

namespace meniscus {

/// The directory that contains this program.
std::filesystem::path own_directory();

/// Replaces this process by meniscus-study, which lies beside this program. `argv`: "meniscus study
/// ...". Throws FileError if it was not built.
[[noreturn]] void hand_over_to_studies(char** argv);

/// Replaces this process by tools/plotting/NAME.py. The script is looked for where this program is
/// installed, then in the sources from which it was built. `argv`: "meniscus NAME ...". Throws
/// FileError if neither exists.
[[noreturn]] void hand_over_to_python(const std::string& name, char** argv);

}  // namespace meniscus
