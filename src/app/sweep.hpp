// SPDX-License-Identifier: BSD-3-Clause
// Runs a scene with several values of some keys.
#pragma once
#include "app/swept_runs.hpp"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

struct SweepRequest {
  std::string scene, output;
  std::vector<std::string> set;  ///< "key=value,value,..."; of a random sample "key=low,high"
  int random = 0;                ///< runs of a random sample; 0: all combinations
  int parallel = 1;              ///< runs at the same time
  int threads = 0;               ///< of each run; 0: all cores, shared by runs at the same time
  bool overwrite = false;
};

/// Makes the runs that have not been made yet, each as a process of its own. The results of a run
/// are in a directory whose name contains its values. Writes sweep.csv with a row of final numbers
/// for each run. A run that fails does not stop the sweep. A signal stops it; the same command then
/// continues it. Returns the most severe exit code of all runs. Throws InputError, FileError.
int sweep(const SweepRequest& request);
/// Makes the given runs; `request.set` and `request.random` are not read.
int sweep(const SweepRequest& request, SweptRuns runs);

/// The rows of sweep.csv: the values of the keys, and the numbers of each run by name.
class SweepTable {
 public:
  using Values = SweptRuns::Values;
  struct Row {
    int exit_code = 0;
    std::map<std::string, std::string> numbers;  ///< by column
  };

  explicit SweepTable(std::vector<std::string> keys) : keys_(std::move(keys)) {}
  /// Reads the rows of a file that was made from text(). Throws InputError if the file has other
  /// keys.
  void read(const std::string& text, const std::string& name);
  /// Sets the row of a run. Columns are in the order of their first appearance.
  void put(const Values& values, int exit_code,
           const std::vector<std::array<std::string, 3>>& name_unit_number);
  const Row* find(const Values& values) const;
  /// Puts the rows of these runs in this order, behind all others.
  void arrange(const std::vector<Values>& order);
  /// The table as CSV: names in the first line, units in the second.
  std::string text() const;

 private:
  void add_column(const std::string& name, const std::string& unit);

  std::vector<std::string> keys_;
  std::vector<std::pair<std::string, std::string>> columns_;  ///< name, unit
  std::vector<std::pair<Values, Row>> rows_;
};

}  // namespace meniscus
