// SPDX-License-Identifier: BSD-3-Clause
// The printed table of keys.
#include "input/key_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace meniscus {

void print(std::ostream& out, const KeyTable& table) {
  using Line = std::array<std::string, 6>;
  std::vector<Line> lines{{"key", "type", "unit", "range", "default", "meaning"}};
  for (const KeyText& k : table.keys)
    lines.push_back({k.key, k.type, k.unit, k.range, k.fallback, k.meaning});
  std::array<std::size_t, 6> width{};
  for (const Line& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) width[i] = std::max(width[i], line[i].size());
  out << table.heading << "\n";
  for (const Line& line : lines) {
    out << " ";
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      out << fmt::format(" {:<{}} ", line[i], width[i]);
    out << " " << line.back() << "\n";
  }
  if (table.example.empty()) return;
  out << "  example\n";
  std::istringstream example(table.example);
  for (std::string line; std::getline(example, line);) out << "    " << line << "\n";
}

}  // namespace meniscus
