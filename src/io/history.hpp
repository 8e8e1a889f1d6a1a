// SPDX-License-Identifier: BSD-3-Clause
// history.csv: numbers over time, one row per record.
//
//   # time,kinetic_energy
//   # s,J
//   0,1.25
// Two comment lines with names and units, then rows with 17 digits (they read back bit for bit),
// each on the disk's side of the program as soon as it is written (`tail -f`). In Python:
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
  std::string name;  ///< without comma and line break; the first column is "time"
  std::string unit = "1";
  friend bool operator==(const HistoryColumn&, const HistoryColumn&) = default;
};

/// Writes or continues history.csv.
class HistoryWriter {
 public:
  /// Begins a new file. With `continue_after`, an existing file is continued: its rows up to that
  /// time stay (the one at that time too), later ones and an incomplete last one are cut.
  /// Throws FileError if the file cannot be written or the columns are others.
  HistoryWriter(const std::filesystem::path& file, std::vector<HistoryColumn> columns,
                std::optional<Real> continue_after = {});

  /// Adds one row, a value per column. Throws SolveError that names the first column whose value is
  /// infinite or not a number, and writes nothing then; throws FileError if writing fails.
  void write(std::span<const Real> values);

 private:
  std::filesystem::path path_;
  std::vector<HistoryColumn> columns_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// A history read from its file.
class History {
 public:
  /// An incomplete last row is left out. Throws FileError naming the line if the file is not a
  /// history.
  static History read(const std::filesystem::path& file);

  const std::vector<HistoryColumn>& columns() const { return columns_; }
  std::size_t rows() const { return values_.front().size(); }
  bool has(std::string_view name) const;
  /// The values of a column. Throws FileError listing the names there are.
  const std::vector<Real>& column(std::string_view name) const;

 private:
  std::vector<HistoryColumn> columns_;
  std::vector<std::vector<Real>> values_;  ///< by column
};

}  // namespace meniscus
