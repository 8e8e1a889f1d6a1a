// SPDX-License-Identifier: BSD-3-Clause
// Files and directories: small text files, written so that a reader never meets half of one, and
// what is there. All throw FileError with the reason of the operating system.
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

/// The name under which a file is written before it takes the place of `path`.
std::filesystem::path temporary_name(const std::filesystem::path& path);

/// Removes a file under its temporary name at the end of its life; after rename_file() there is
/// none.
class RemovedUnlessRenamed {
 public:
  explicit RemovedUnlessRenamed(std::filesystem::path temporary);
  ~RemovedUnlessRenamed();
  RemovedUnlessRenamed(const RemovedUnlessRenamed&) = delete;

 private:
  std::filesystem::path temporary_;
};

/// Whether there is something of that name. Throws if that cannot be known: in a directory without
/// permission, in a loop of links, for a name that is too long.
bool is_there(const std::filesystem::path& path);
/// Whether that is a directory. Throws as is_there().
bool is_directory_there(const std::filesystem::path& path);
/// Whether both are there and are one file or directory.
bool are_same(const std::filesystem::path& a, const std::filesystem::path& b);
/// Paths of all that is in a directory, in no order.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& directory);
/// Throws if the path is there and is not a regular file itself: nothing is written through a link,
/// into a pipe or a device.
void refuse_unless_regular(const std::filesystem::path& path);

/// The content of a regular file of 4 GB at most.
std::string read_file(const std::filesystem::path& path);
/// Calls take(piece) for the bytes of a regular file, in order. A pipe or a device, which would
/// never end, is refused.
void read_pieces(const std::filesystem::path& path,
                 const std::function<void(std::string_view)>& take);
/// Writes a file that is not there yet; never through a link.
void write_new_file(const std::filesystem::path& path, std::string_view content);
void overwrite_beginning(const std::filesystem::path& path, std::string_view content);
/// Moves `from` over `to` in one step.
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);
/// Removes a file that may be there.
void remove_file(const std::filesystem::path& path);
/// Writes under the temporary name, then renames.
void replace_file(const std::filesystem::path& path, std::string_view content);
/// Makes the directory and those above it where they are missing.
void make_directory(const std::filesystem::path& path);
/// Returns when the file (or the list of names of a directory) is on the disk.
void sync_to_disk(const std::filesystem::path& path);

}  // namespace meniscus
