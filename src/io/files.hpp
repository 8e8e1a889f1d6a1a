// SPDX-License-Identifier: BSD-3-Clause
// Files and directories: reading, and writing of small text files that a reader never sees half
// written. All functions throw FileError with the reason that the operating system gives.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// "cannot <doing> '<path>': <reason of errno>"
[[noreturn]] void throw_file_error(std::string_view doing, const std::filesystem::path& path,
                                   int error_number);

/// The temporary name under which a new version of `path` is written before it is renamed to
/// `path`.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Its destructor removes the file with the temporary name. After rename_file() this file does not
/// exist any more.
class RemovedUnlessRenamed {
 public:
  explicit RemovedUnlessRenamed(std::filesystem::path temporary);
  ~RemovedUnlessRenamed();
  RemovedUnlessRenamed(const RemovedUnlessRenamed&) = delete;

 private:
  std::filesystem::path temporary_;
};

/// True if something with this name exists. Throws if this cannot be found out: in a directory
/// without permission, in a loop of links, for a name that is too long.
bool is_there(const std::filesystem::path& path);
/// True if the path is a directory. Throws like is_there().
bool is_directory_there(const std::filesystem::path& path);
/// True if both paths exist and are the same file or directory.
bool are_same(const std::filesystem::path& a, const std::filesystem::path& b);
/// Paths of all entries of a directory, unsorted.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& directory);
/// Throws if the path exists and is not a regular file, so that nothing is written through a link,
/// into a pipe or into a device.
void refuse_unless_regular(const std::filesystem::path& path);

/// The content of a regular file of at most 4 GB.
std::string read_file(const std::filesystem::path& path);
/// Calls take(piece) for the bytes of a regular file, in order. Throws for a pipe or a device,
/// which would never end.
void read_pieces(const std::filesystem::path& path,
                 const std::function<void(std::string_view)>& take);
/// Writes a new file. Throws if the name exists, also as a link.
void write_new_file(const std::filesystem::path& path, std::string_view content);
void overwrite_beginning(const std::filesystem::path& path, std::string_view content);
/// Renames `from` to `to`, which is replaced in one step.
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);
/// Removes a file if it exists.
void remove_file(const std::filesystem::path& path);
/// Writes a file with the temporary name and renames it.
void replace_file(const std::filesystem::path& path, std::string_view content);
/// Makes the directory and its parents if they do not exist.
void make_directory(const std::filesystem::path& path);
/// Waits until the file, or the list of names of a directory, is on the disk.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace meniscus
