// SPDX-License-Identifier: BSD-3-Clause
// sweep.csv: the final values of each run of a sweep.
#include "app/sweep.hpp"
#include "input/text.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

namespace meniscus {
namespace {

using Cells = std::vector<std::string>;

std::string cell_of(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string line_of(const Cells& cells) {
  Cells texts;
  for (const std::string& text : cells) texts.push_back(cell_of(text));
  return joined(texts, ",") + "\n";
}

/// The cells of all lines of a CSV file. A quote within a quoted cell is written twice.
std::vector<Cells> cells_of(const std::string& text) {
  std::vector<Cells> lines(1, Cells(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      lines.back().back() += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && c == ',')
      lines.back().emplace_back();
    else if (!quoted && c == '\n')
      lines.emplace_back(1);
    else
      lines.back().back() += c;
  }
  lines.pop_back();  // the empty line behind the last line break
  return lines;
}

}  // namespace

void SweepTable::read(const std::string& text, const std::string& name) {
  const std::vector<Cells> lines = cells_of(text);
  const auto n = static_cast<std::ptrdiff_t>(keys_.size());
  const auto same_length = [&](const Cells& line) { return line.size() == lines.front().size(); };
  if (lines.size() < 2 || lines.front().size() <= keys_.size() ||
      !std::all_of(lines.begin(), lines.end(), same_length) ||
      !std::equal(keys_.begin(), keys_.end(), lines.front().begin()) ||
      lines.front()[keys_.size()] != "exit_code")
    throw InputError(fmt::format(
        "'{}' is no table of a sweep over {}; --output names another directory, --overwrite "
        "begins anew",
        name, joined(keys_, ", ")));
  for (std::size_t c = keys_.size() + 1; c < lines[0].size(); ++c)
    add_column(lines[0][c], lines[1][c]);
  for (std::size_t k = 2; k < lines.size(); ++k) {
    Row row{std::atoi(lines[k][keys_.size()].c_str()), {}};
    for (std::size_t c = keys_.size() + 1; c < lines[k].size(); ++c)
      if (!lines[k][c].empty()) row.numbers[lines[0][c]] = lines[k][c];
    rows_.emplace_back(Values(lines[k].begin(), lines[k].begin() + n), std::move(row));
  }
}

void SweepTable::add_column(const std::string& name, const std::string& unit) {
  if (std::none_of(columns_.begin(), columns_.end(),
                   [&](const auto& c) { return c.first == name; }))
    columns_.emplace_back(name, unit);
}

void SweepTable::put(const Values& values, int exit_code,
                     const std::vector<std::array<std::string, 3>>& name_unit_number) {
  Row row{exit_code, {}};
  for (const auto& [name, unit, number] : name_unit_number) {
    add_column(name, unit);
    row.numbers[name] = number;
  }
  std::erase_if(rows_, [&](const auto& r) { return r.first == values; });
  rows_.emplace_back(values, std::move(row));
}

const SweepTable::Row* SweepTable::find(const Values& values) const {
  const auto found = std::find_if(rows_.begin(), rows_.end(),
                                  [&](const auto& row) { return row.first == values; });
  return found == rows_.end() ? nullptr : &found->second;
}

void SweepTable::arrange(const std::vector<Values>& order) {
  const auto place = [&](const std::pair<Values, Row>& row) {
    const auto found = std::find(order.begin(), order.end(), row.first);
    return found == order.end() ? -1 : found - order.begin();
  };
  std::stable_sort(rows_.begin(), rows_.end(),
                   [&](const auto& a, const auto& b) { return place(a) < place(b); });
}

std::string SweepTable::text() const {
  Cells names = keys_, units(keys_.size());
  names.push_back("exit_code");
  units.push_back("");
  for (const auto& [name, unit] : columns_) {
    names.push_back(name);
    units.push_back(unit);
  }
  std::string text = line_of(names) + line_of(units);
  for (const auto& [values, row] : rows_) {
    Cells cells = values;
    cells.push_back(fmt::format("{}", row.exit_code));
    for (const auto& column : columns_) {
      const auto number = row.numbers.find(column.first);
      cells.push_back(number == row.numbers.end() ? "" : number->second);
    }
    text += line_of(cells);
  }
  return text;
}

}  // namespace meniscus
