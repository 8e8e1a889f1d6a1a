// SPDX-License-Identifier: BSD-3-Clause
// A scene run with all combinations of values of some keys.
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

/// Runs what has not been run yet, one after the other in processes of their own, each into a
/// directory with its values in the name, and writes sweep.csv: a row for each run with what it
/// ended with. A run that fails does not stop the others; a signal does, and the same command goes
/// on. Returns the gravest exit code of all runs. Throws InputError, FileError.
int sweep(const SweepRequest& request);

/// One key and its values, as texts.
struct SweptKey {
  std::string key;
  std::vector<std::string> values;
};

/// Of "key=a,b,c": commas within brackets and quotes belong to a value. Throws InputError.
SweptKey swept_key(const std::string& setting);

/// The rows of sweep.csv: the values of the keys, and numbers by name.
class SweepTable {
 public:
  using Values = std::vector<std::string>;
  struct Row {
    int exit_code = 0;
    std::map<std::string, std::string> numbers;  ///< by column
  };

  explicit SweepTable(std::vector<std::string> keys) : keys_(std::move(keys)) {}
  /// Rows of a file that write() has made. Throws InputError if it is of other keys.
  void read(const std::string& text, const std::string& name);
  /// Columns in the order in which they are seen first, with their units.
  void put(const Values& values, int exit_code,
           const std::vector<std::array<std::string, 3>>& name_unit_number);
  const Row* find(const Values& values) const;
  /// Names in the first line, units in the second.
  std::string text() const;

 private:
  void add_column(const std::string& name, const std::string& unit);

  std::vector<std::string> keys_;
  std::vector<std::pair<std::string, std::string>> columns_;  ///< name, unit
  std::vector<std::pair<Values, Row>> rows_;
};

}  // namespace meniscus
