// SPDX-License-Identifier: BSD-3-Clause
// Texts about the command line that are made from the command line itself: completion of the shell
// and the manual page.
#pragma once
#include <string>
#include <vector>

namespace meniscus {

struct OptionText {
  std::vector<std::string> names;  ///< "--output", "-q"; none of what is given by its place
  std::string value;               ///< "DIR"; empty of a flag
  std::string meaning;
  bool required = false;
};

struct CommandText {
  std::string name, meaning;
  std::vector<OptionText> options;
};

/// A script for bash that completes commands, options and their values.
std::string bash_completion(const std::vector<CommandText>& commands);

/// The manual page in the language of man. `description` is a sentence, `exit_codes` text.
std::string manual_page(const std::vector<CommandText>& commands, const std::string& version,
                        const std::string& description, const std::string& exit_codes);

}  // namespace meniscus
