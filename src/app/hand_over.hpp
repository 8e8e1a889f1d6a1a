// SPDX-License-Identifier: BSD-3-Clause
// Commands that are programs of their own.
#pragma once
#include <filesystem>
#include <string>

namespace meniscus {

/// The directory of this program.
std::filesystem::path own_directory();

/// Replaces this process by meniscus-study, which lies beside this program. `argv`: "meniscus study
/// ...". Throws FileError if it was not built.
[[noreturn]] void hand_over_to_studies(char** argv);

/// Replaces this process by tools/plotting/NAME.py, as installed with this program or of the
/// sources that it was built from; `argv`: "meniscus NAME ...". Throws FileError if neither is
/// there.
[[noreturn]] void hand_over_to_python(const std::string& name, char** argv);

}  // namespace meniscus
