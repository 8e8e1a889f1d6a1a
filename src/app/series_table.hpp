// SPDX-License-Identifier: BSD-3-Clause
// Results of a scene along one of its parameters, and tables of them.
#pragma once
#include "app/sweep.hpp"
#include "numbers/convergence.hpp"
#include "numbers/types.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meniscus {

/// Runs of a scene, of which a parameter h falls from run to run.
class Series {
 public:
  /// `rows`: of sweep.csv, one for each h; null: the run is missing.
  Series(std::vector<Real> h, std::vector<const SweepTable::Row*> rows)
      : h_(std::move(h)), rows_(std::move(rows)) {}

  /// The numbers of a column; empty where a run has none.
  std::vector<std::optional<Real>> values(const std::string& column) const;
  /// Empty if one of the numbers is missing, or if there are fewer than three.
  std::optional<Convergence> convergence(const std::string& column) const;

 private:
  std::vector<Real> h_;
  std::vector<const SweepTable::Row*> rows_;
};

using TableLines = std::vector<std::vector<std::string>>;  ///< the first line names the columns

/// Prints the lines with aligned columns, and writes them to a file of comma-separated values.
/// Throws FileError.
void print_and_write(const TableLines& lines, const std::filesystem::path& file);

}  // namespace meniscus
