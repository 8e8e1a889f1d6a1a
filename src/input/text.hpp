// SPDX-License-Identifier: BSD-3-Clause
// Texts made of texts. Formatted numbers come from fmt/core.h; fmt/format.h would compile the whole
// formatting engine into every file that uses it.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// "a, b, c" for the separator ", ".
std::string joined(const std::vector<std::string>& items, std::string_view separator);

/// The text as a terminal may show it. Each control character but line break and tabulator, each
/// character that changes the direction of writing or is invisible, and each byte that is no UTF-8
/// becomes '?'.
std::string printable(std::string_view text);

/// The message as somebody can read it: printable(), with the middle of long quotations 'formula'
/// and of long lines left out.
std::string readable(std::string_view message);

}  // namespace meniscus
