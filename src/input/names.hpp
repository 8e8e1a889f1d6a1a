// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for names that are misspelt or those of other programs.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// Insertions, deletions, replacements and swaps of neighbouring characters that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "; did you mean 'b'?", or nothing when no known name is near, i.e. within a third of its
/// letters.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& known);

/// The end of a message about an unknown name: "allowed are a, b, c; did you mean 'b'?", or
/// where to find what another program calls so ("gravity", "dt", "sphere", "youngs_modulus").
std::string allowed_names(std::string_view given, const std::vector<std::string>& known);

/// The table or key of a scene for a word of other programs: "body_force" for "gravity"; empty if
/// it is none of these.
std::string_view own_word(std::string_view foreign);

}  // namespace meniscus
