// SPDX-License-Identifier: BSD-3-Clause
// Results of a scene along one of its parameters, and tables of them.
#include "app/series_table.hpp"

#include "app/print.hpp"
#include "input/text.hpp"
#include "io/files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>

namespace meniscus {
namespace {

std::optional<Real> number_in(const SweepTable::Row* row, const std::string& column) {
  if (!row || !row->numbers.contains(column)) return std::nullopt;
  const std::string& text = row->numbers.at(column);
  Real value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value)
                                                                  : std::nullopt;
}

}  // namespace

std::vector<std::optional<Real>> Series::values(const std::string& column) const {
  std::vector<std::optional<Real>> all;
  for (const SweepTable::Row* row : rows_) all.push_back(number_in(row, column));
  return all;
}

std::optional<Convergence> Series::convergence(const std::string& column) const {
  std::vector<Real> numbers;
  for (const std::optional<Real>& value : values(column))
    if (value) numbers.push_back(*value);
  if (numbers.size() < rows_.size() || numbers.size() < 3) return std::nullopt;
  return convergence_of(h_, numbers);
}

void print_and_write(const TableLines& lines, const std::filesystem::path& file) {
  std::vector<std::size_t> width(lines.front().size(), 0);
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) width[c] = std::max(width[c], line[c].size());
  std::string csv;
  for (const auto& line : lines) {
    std::string text = fmt::format("{:<{}}", line[0], width[0]);
    for (std::size_t c = 1; c < line.size(); ++c)
      text += fmt::format("  {:>{}}", line[c], width[c]);
    text.erase(text.find_last_not_of(' ') + 1);
    say("{}\n", text);
    csv += joined(line, ",") + "\n";
  }
  replace_file(file, csv);
  say("written to {}\n", file.string());
}

}  // namespace meniscus
