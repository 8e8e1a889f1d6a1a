// SPDX-License-Identifier: BSD-3-Clause
// Texts generated from the definition of the command line: completion for the shell, and the manual
// page.
#pragma once
#include <string>
#include <vector>

namespace meniscus {

struct OptionText {
  std::vector<std::string> names;  ///< "--output", "-q"; empty for a positional argument
  std::string value;               ///< "DIR"; empty for a flag
  std::string meaning;
  bool required = false;
};

struct CommandText {
  std::string name, meaning;
  std::vector<OptionText> options;
};

/// A bash script that completes commands, options and their values.
std::string bash_completion(const std::vector<CommandText>& commands);

/// The manual page in the format of man. `description` is a sentence; `exit_codes` is a text.
std::string manual_page(const std::vector<CommandText>& commands, const std::string& version,
                        const std::string& description, const std::string& exit_codes);

}  // namespace meniscus
