// SPDX-License-Identifier: BSD-3-Clause
// Directory for the results of a run, locked so that one process writes to it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace meniscus {

/// How to treat an earlier run in the directory.
enum class ExistingRun {
  refuse,   ///< throw FileError if there is one
  replace,  ///< remove its files (--overwrite); other files stay
  keep,     ///< continue it
  leave     ///< do nothing: another rank has made and locked the directory
};

/// The existing result files of a run in `directory`, ordered by epoch: run.h5, run.1.h5, ...
/// `name` replaces "run" for other kinds of result files.
std::vector<std::filesystem::path> result_series(const std::filesystem::path& directory,
                                                 const std::string& name = "run");

/// The file that viewers open: run.vtkhdf for run.h5.
std::filesystem::path view_of(const std::filesystem::path& result_file);
/// Removes a result file and its view. Throws FileError.
void remove_result(const std::filesystem::path& result_file);

/// A directory with the files run.h5 (run.1.h5, ... after remaps), run.vtkhdf, run.xdmf,
/// history.csv, run.log, checkpoint-a.h5 and checkpoint-b.h5. There are also partners.h5 with its
/// views for rigid partners, revolved.h5 for surfaces of revolution, and probe-NAME.csv for lines
/// of points. While the object lives, no other program can write results there. The lock ends with
/// the process, even if the process is killed.
class RunDirectory {
 public:
  /// Makes the directory if needed. Throws FileError if the directory cannot be made or written to,
  /// if it is not a directory, if it contains a run (ExistingRun::refuse), or if another program is
  /// writing to it.
  RunDirectory(std::filesystem::path path, ExistingRun existing);
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Path of a result file: NAME.h5 for number 0, NAME.<number>.h5 otherwise.
  std::filesystem::path result_file(std::size_t number = 0, const std::string& name = "run") const;
  std::filesystem::path history_file() const { return path_ / "history.csv"; }
  std::filesystem::path probe_file(const std::string& name) const {
    return path_ / ("probe-" + name + ".csv");
  }
  std::filesystem::path log_file() const { return path_ / "run.log"; }

 private:
  void lock();

  std::filesystem::path path_;
  int lock_ = -1;  ///< file descriptor of the directory
};

}  // namespace meniscus
