// SPDX-License-Identifier: BSD-3-Clause
// The file history.csv: numbers over time, one row per record.
//
//   # time,kinetic_energy
//   # s,J
//   0,1.25
//
// Two comment lines with names and units are followed by rows of numbers with 17 digits. The digits
// read back bit for bit. Each row is flushed after writing (`tail -f` shows it). To read it in
// Python:
//   names = open(f).readline()[2:].strip().split(','); numpy.loadtxt(f, delimiter=',')
#pragma once
#include "numbers/types.hpp"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

struct HistoryColumn {
  std::string name;  ///< no comma or line break; the first column is "time"
  std::string unit = "1";
  friend bool operator==(const HistoryColumn&, const HistoryColumn&) = default;
};

/// Writes or continues history.csv.
class HistoryWriter {
 public:
  /// Begins a new file. With `continue_after`, continues an existing file: rows up to and including
  /// this time are kept; later rows and an incomplete last row are removed. Throws FileError if the
  /// file cannot be written or has other columns.
  HistoryWriter(const std::filesystem::path& file, std::vector<HistoryColumn> columns,
                std::optional<Real> continue_after = {});

  /// Adds a row with one value per column. If a value is infinite or NaN, writes nothing and throws
  /// SolveError, which names the first such column. Throws FileError if writing fails.
  void write(std::span<const Real> values);

 private:
  std::filesystem::path path_;
  std::vector<HistoryColumn> columns_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// A history read from its file.
class History {
 public:
  /// Reads a file; an incomplete last row is left out. Throws FileError with the line if the file
  /// is not a history.
  static History read(const std::filesystem::path& file);

  const std::vector<HistoryColumn>& columns() const { return columns_; }
  std::size_t rows() const { return values_.front().size(); }
  bool has(std::string_view name) const;
  /// The values of a column. Throws FileError with the names of all columns if there is no such
  /// column.
  const std::vector<Real>& column(std::string_view name) const;

 private:
  std::vector<HistoryColumn> columns_;
  std::vector<std::vector<Real>> values_;  ///< by column
};

}  // namespace meniscus
