// SPDX-License-Identifier: BSD-3-Clause
// What the command lines of the programs have in common.
#pragma once
#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <charconv>
#include <climits>
#include <cstdint>
#include <string>

namespace meniscus {

/// An integer of a range, refused by a sentence.
inline CLI::Validator integer_between(std::int64_t low, std::int64_t high) {
  return CLI::Validator(
      [=](const std::string& text) {
        std::int64_t value = 0;
        const char* end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc() && rest == end && value >= low && value <= high)
          return std::string();
        return fmt::format("'{}' is out of range; allowed is an integer >= {}{}", text, low,
                           high < INT_MAX ? fmt::format(" and <= {}", high) : "");
      },
      "");
}

}  // namespace meniscus
