// SPDX-License-Identifier: BSD-3-Clause
// Runs a scene with all combinations of given values of some keys.
#pragma once
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

struct SweepRequest {
  std::string scene, output;
  std::vector<std::string> set;  ///< "key=value,value,..."
  int threads = 0;               ///< 0: all cores
  bool overwrite = false;
};

/// Runs the combinations that have not been run yet, one after the other, each as a process of its
/// own. The results of a run are in a directory whose name contains its values. Writes sweep.csv
/// with a row of final numbers for each run. A run that fails does not stop the sweep. A signal
/// stops it; the same command then continues it. Returns the most severe exit code of all runs.
/// Throws InputError, FileError.
int sweep(const SweepRequest& request);

/// One key and its values, as texts.
struct SweptKey {
  std::string key;
  std::vector<std::string> values;
};

/// Splits "key=a,b,c" into the key and its values. A comma within brackets or quotes does not
/// separate values. Throws InputError.
SweptKey swept_key(const std::string& setting);

/// The rows of sweep.csv: the values of the keys, and the numbers of each run by name.
class SweepTable {
 public:
  using Values = std::vector<std::string>;
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
  /// The table as CSV: names in the first line, units in the second.
  std::string text() const;

 private:
  void add_column(const std::string& name, const std::string& unit);

  std::vector<std::string> keys_;
  std::vector<std::pair<std::string, std::string>> columns_;  ///< name, unit
  std::vector<std::pair<Values, Row>> rows_;
};

}  // namespace meniscus
