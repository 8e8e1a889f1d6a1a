// SPDX-License-Identifier: BSD-3-Clause
// Creates, locks and clears the directory of a run.
#include "io/run_directory.hpp"

#include "io/files.hpp"
#include "meniscus/error.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace meniscus {
namespace {

/// All files of a run. A directory counts as used if it has one of the first four.
constexpr const char* run_files[] = {"run.h5",      "checkpoint-a.h5", "checkpoint-b.h5",
                                     "history.csv", "run.xdmf",        "run.vtkhdf.series",
                                     "run.log",     "partners.xdmf",   "revolved.xdmf"};
constexpr int telling_files = 4;
constexpr const char* series_names[] = {"run", "partners", "revolved"};

void refuse_existing_run(const std::filesystem::path& directory) {
  for (int i = 0; i < telling_files; ++i)
    if (is_there(directory / run_files[i]))
      throw FileError(
          fmt::format("'{}' already holds a run ({}); choose another directory with --output, "
                      "replace the run with --overwrite, or continue it with --restart",
                      directory.string(), run_files[i]));
}

std::filesystem::path in_series(const std::filesystem::path& directory, const std::string& name,
                                std::size_t number) {
  return directory / (number == 0 ? name + ".h5" : fmt::format("{}.{}.h5", name, number));
}

/// Removes temporary files that a killed run had not renamed yet.
void remove_temporaries(const std::filesystem::path& directory) {
  for (const char* name : run_files) remove_file(temporary_name(directory / name));
  // The last result file may lack its view; the temporary file of the next one may exist.
  for (const char* name : series_names) {
    const std::size_t next = result_series(directory, name).size();
    for (std::size_t number = next > 0 ? next - 1 : 0; number <= next; ++number) {
      const std::filesystem::path file = in_series(directory, name, number);
      for (const auto& path : {file, view_of(file)}) remove_file(temporary_name(path));
    }
  }
}

/// Files probe-NAME.csv of lines of points and beside-K.csv, of this run or an earlier one.
std::vector<std::filesystem::path> tables_of(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  for (const auto& path : entries_of(directory))
    if (const std::string name = path.filename().string();
        (name.starts_with("probe-") || name.starts_with("beside-")) && path.extension() == ".csv")
      files.push_back(path);
  return files;
}

/// Throws FileError if a file of a run is a link, since somebody else may have created it.
void refuse_links(const std::filesystem::path& directory) {
  for (const char* name : run_files) refuse_unless_regular(directory / name);
  for (const char* name : series_names)
    for (const auto& file : result_series(directory, name))
      for (const auto& path : {file, view_of(file)}) refuse_unless_regular(path);
  for (const auto& file : tables_of(directory)) refuse_unless_regular(file);
}

void remove_run(const std::filesystem::path& directory) {
  for (const char* name : series_names) {
    const auto series = result_series(directory, name);
    for (auto file = series.rbegin(); file != series.rend(); ++file) remove_result(*file);
  }
  for (const char* name : run_files) remove_file(directory / name);
  for (const auto& file : tables_of(directory)) remove_file(file);
}

}  // namespace

std::vector<std::filesystem::path> result_series(const std::filesystem::path& directory,
                                                 const std::string& name) {
  std::vector<std::filesystem::path> files;
  while (is_there(in_series(directory, name, files.size())))
    files.push_back(in_series(directory, name, files.size()));
  return files;
}

std::filesystem::path view_of(const std::filesystem::path& result_file) {
  return std::filesystem::path(result_file).replace_extension("vtkhdf");
}

void remove_result(const std::filesystem::path& result_file) {
  remove_file(view_of(result_file));
  remove_file(result_file);
}

RunDirectory::RunDirectory(std::filesystem::path path, ExistingRun existing)
    : path_(std::move(path)) {
  if (existing == ExistingRun::leave) return;
  make_directory(path_);
  if (!is_directory_there(path_)) throw_file_error("write to", path_, ENOTDIR);
  if (access(path_.c_str(), W_OK | X_OK) != 0) throw_file_error("write to", path_, errno);
  if (existing == ExistingRun::refuse) refuse_existing_run(path_);
  lock();
  try {
    remove_temporaries(path_);
    existing == ExistingRun::replace ? remove_run(path_) : refuse_links(path_);
  } catch (...) {
    close(lock_);
    throw;
  }
}

RunDirectory::~RunDirectory() {
  if (lock_ >= 0) close(lock_);
}

std::filesystem::path RunDirectory::result_file(std::size_t number, const std::string& name) const {
  return in_series(path_, name, number);
}

void RunDirectory::lock() {
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) throw_file_error("open", path_, errno);
  if (flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
  const int error_number = errno;
  if (error_number == EWOULDBLOCK) {
    close(lock_);
    throw FileError(
        fmt::format("another run is writing its results to '{}'; wait for it, or choose another "
                    "directory with --output",
                    path_.string()));
  }
  // The file system has no locks: other writers cannot be detected, and nothing is refused.
}

}  // namespace meniscus
