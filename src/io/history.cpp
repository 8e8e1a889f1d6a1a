// SPDX-License-Identifier: BSD-3-Clause
// Writing, continuing and reading history.csv.
#include "io/history.hpp"

#include "input/text.hpp"
#include "io/files.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace meniscus {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts(1);
  for (const char c : line)
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// The complete lines, which end in a line break.
std::vector<std::string> complete_lines(const std::string& content) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end; (end = content.find('\n', begin)) != content.npos; begin = end + 1)
    lines.push_back(content.substr(begin, end - begin));
  return lines;
}

std::string row_text(std::span<const Real> values) {
  std::string row;
  for (const Real value : values) row += fmt::format("{:.17g},", value);
  row.back() = '\n';
  return row;
}

std::string header_text(const std::vector<HistoryColumn>& columns) {
  std::vector<std::string> names, units;
  for (const HistoryColumn& column : columns) {
    if ((column.name + column.unit).find_first_of(",\n") != std::string::npos)
      throw std::invalid_argument(fmt::format("history column '{}'", column.name));
    names.push_back(column.name);
    units.push_back(column.unit);
  }
  if (names.empty() || names[0] != "time")
    throw std::invalid_argument("the first column of a history is 'time'");
  return fmt::format("# {}\n# {}\n", joined(names, ","), joined(units, ","));
}

/// Header and kept rows of a history that is continued.
std::string kept_part(const std::filesystem::path& path, const std::vector<HistoryColumn>& columns,
                      Real last_time) {
  const History history = History::read(path);
  if (history.columns() != columns)
    throw FileError(
        fmt::format("cannot continue '{}': its columns differ from those of this run; choose "
                    "another directory with --output",
                    path.string()));
  std::string kept = header_text(columns);
  std::vector<Real> row(columns.size());
  for (std::size_t r = 0; r < history.rows(); ++r) {
    for (std::size_t c = 0; c < columns.size(); ++c) row[c] = history.column(columns[c].name)[r];
    if (row[0] <= last_time) kept += row_text(row);
  }
  return kept;
}

}  // namespace

HistoryWriter::HistoryWriter(const std::filesystem::path& file, std::vector<HistoryColumn> columns,
                             std::optional<Real> continue_after)
    : path_(file), columns_(std::move(columns)), file_(nullptr, std::fclose) {
  const bool continuing = continue_after && is_there(path_);
  replace_file(path_,
               continuing ? kept_part(path_, columns_, *continue_after) : header_text(columns_));
  file_.reset(std::fopen(path_.c_str(), "ab"));
  if (!file_) throw_file_error("write", path_, errno);
}

void HistoryWriter::write(std::span<const Real> values) {
  if (values.size() != columns_.size())
    throw std::invalid_argument(
        fmt::format("{} values for {} history columns", values.size(), columns_.size()));
  for (std::size_t c = 0; c < values.size(); ++c)
    if (!std::isfinite(values[c]))
      throw SolveError(
          fmt::format("{} = {:.9g}: the column '{}' of {} would be {}; expected is a finite number",
                      columns_[0].name, values[0], columns_[c].name, path_.filename().string(),
                      std::isnan(values[c]) ? "not a number" : "infinite"));
  const std::string row = row_text(values);
  if (std::fwrite(row.data(), 1, row.size(), file_.get()) != row.size() ||
      std::fflush(file_.get()) != 0)
    throw_file_error("write", path_, errno);
}

History History::read(const std::filesystem::path& file) {
  const std::vector<std::string> lines = complete_lines(read_file(file));
  const auto fail = [&](std::size_t line, std::string_view what) {
    throw FileError(fmt::format("{}:{}: {}", file.string(), line, what));
  };
  if (lines.size() < 2 || !lines[0].starts_with("# time") || !lines[1].starts_with("# "))
    fail(1, "this is not a history: it does not begin with a line of names and one of units");
  const auto names = split(lines[0].substr(2)), units = split(lines[1].substr(2));
  if (names.size() != units.size()) fail(2, "there is not one unit per name");
  History history;
  for (std::size_t c = 0; c < names.size(); ++c) history.columns_.push_back({names[c], units[c]});
  history.values_.resize(names.size());
  for (std::size_t l = 2; l < lines.size(); ++l) {
    const auto cells = split(lines[l]);
    if (cells.size() != names.size())
      fail(l + 1, fmt::format("{} values for {} columns", cells.size(), names.size()));
    for (std::size_t c = 0; c < cells.size(); ++c) {
      char* end = nullptr;
      history.values_[c].push_back(std::strtod(cells[c].c_str(), &end));
      if (end == cells[c].c_str() || *end != '\0')
        fail(l + 1, fmt::format("'{}' is not a number", cells[c]));
    }
  }
  return history;
}

bool History::has(std::string_view name) const {
  return std::any_of(columns_.begin(), columns_.end(),
                     [&](const auto& c) { return c.name == name; });
}

const std::vector<Real>& History::column(std::string_view name) const {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (columns_[c].name == name) return values_[c];
    names.push_back(columns_[c].name);
  }
  throw FileError(
      fmt::format("the history has no column '{}'; it has: {}", name, joined(names, ", ")));
}

}  // namespace meniscus
