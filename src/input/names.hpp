// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for names that are misspelt, or that belong to other programs.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// Number of insertions, deletions, replacements and swaps of neighbouring characters that turn a
/// into b.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "; did you mean 'b'?" for the nearest known name. Empty if no known name is within a third of
/// the number of letters.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& known);

/// The end of a message about an unknown name: "allowed are a, b, c; did you mean 'b'?". For a name
/// of another program ("gravity", "dt", "sphere", "youngs_modulus"), the text names the
/// corresponding key instead.
std::string allowed_names(std::string_view given, const std::vector<std::string>& known);

/// The table or key of a scene that corresponds to a word of other programs: "body_force" for
/// "gravity". Empty for other words.
std::string_view own_word(std::string_view foreign);

/// True if a text can name a thing of a scene: letters, digits, _ and - only.
bool is_plain_name(std::string_view name);

}  // namespace meniscus
