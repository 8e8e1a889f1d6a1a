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

}  // namespace meniscus
