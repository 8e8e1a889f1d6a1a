// SPDX-License-Identifier: BSD-3-Clause
// Parts of the command line that meniscus and meniscus-study share.
#pragma once
#include "app/commands.hpp"
#include "app/print.hpp"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <charconv>
#include <climits>
#include <cstdint>
#include <sstream>
#include <string>

namespace meniscus {

/// Prints the help or the complaint with which parsing ended, and returns the exit code.
inline int answered(const CLI::App& app, const CLI::ParseError& end) {
  std::ostringstream out, complaint;
  const bool well = app.exit(end, out, complaint) == 0;
  print_text(out.str());
  std::string text = complaint.str();
  while (text.ends_with('\n')) text.pop_back();
  if (!text.empty()) print_complaint(text);
  return well ? exit_ok : exit_usage;
}

/// Refuses an empty value, which a shell passes for a variable that is not set.
inline CLI::Validator not_empty() {
  return CLI::Validator(
      [](const std::string& text) {
        return text.empty() ? std::string("is empty; allowed is a name or value, or no such option")
                            : std::string();
      },
      "");
}

/// Accepts the integers of a range, and refuses others with a sentence.
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
