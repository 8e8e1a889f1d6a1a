// SPDX-License-Identifier: BSD-3-Clause
// Results directory of a run, locked for one writer.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace meniscus {

/// What may happen to a run that is already in the directory.
enum class ExistingRun {
  refuse,   ///< FileError if there is one
  replace,  ///< its files are removed (--overwrite); files of other names stay
  keep,     ///< it is continued
  leave     ///< to another rank, which has made and locked the directory
};

/// The result files of a run in `directory`, in the order of their epochs: run.h5, run.1.h5, ... as
/// many as there are; or those of another name.
std::vector<std::filesystem::path> result_series(const std::filesystem::path& directory,
                                                 const std::string& name = "run");

/// run.vtkhdf of run.h5: what viewers open.
std::filesystem::path view_of(const std::filesystem::path& result_file);
/// Removes a result file and its view. Throws FileError.
void remove_result(const std::filesystem::path& result_file);

/// DIR/run.h5 (run.1.h5, ... after remaps), run.vtkhdf, run.xdmf, the same of rigid partners named
/// partners, history.csv, probe-NAME.csv of lines of points, run.log, checkpoint-a.h5,
/// checkpoint-b.h5. While the object lives no other
/// program can write results there; the lock ends with the process, however it ends.
class RunDirectory {
 public:
  /// Makes the directory if needed. Throws FileError if it cannot be made or written to, is not a
  /// directory, holds a run (ExistingRun::refuse), or another program is writing to it.
  RunDirectory(std::filesystem::path path, ExistingRun existing);
  ~RunDirectory();
  RunDirectory(const RunDirectory&) = delete;
  RunDirectory& operator=(const RunDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Of that number in the series of that name.
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
