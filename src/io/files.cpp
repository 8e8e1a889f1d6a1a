// SPDX-License-Identifier: BSD-3-Clause
// Small text files through the C library, whose errors carry a reason.
#include "io/files.hpp"

#include "input/regular_file.hpp"
#include "meniscus/error.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>

namespace meniscus {
namespace {

void write_to(const std::filesystem::path& path, int flags, std::string_view content) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC | flags, 0666);
  std::FILE* file = descriptor < 0 ? nullptr : fdopen(descriptor, "wb");
  if (!file) throw_file_error("write", path, errno);
  const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
  const int write_error = errno;
  if (std::fclose(file) != 0) throw_file_error("write", path, errno);
  if (!written) throw_file_error("write", path, write_error);
}

}  // namespace

void throw_file_error(std::string_view doing, const std::filesystem::path& path, int error_number) {
  throw FileError(
      fmt::format("cannot {} '{}': {}", doing, path.string(), std::strerror(error_number)));
}

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  return path.string() + ".new";
}

RemovedUnlessRenamed::RemovedUnlessRenamed(std::filesystem::path temporary)
    : temporary_(std::move(temporary)) {}

RemovedUnlessRenamed::~RemovedUnlessRenamed() {
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::none) throw_file_error("read", path, error.value());
  return type != std::filesystem::file_type::not_found;
}

bool is_directory_there(const std::filesystem::path& path) {
  std::error_code error;
  return is_there(path) && std::filesystem::is_directory(path, error);
}

bool are_same(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  return is_there(a) && is_there(b) && std::filesystem::equivalent(a, b, error);
}

std::vector<std::filesystem::path> entries_of(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> paths;
  std::error_code error;
  for (std::filesystem::directory_iterator at(directory, error), end; !error && at != end;
       at.increment(error))
    paths.push_back(at->path());
  if (error) throw_file_error("read", directory, error.value());
  return paths;
}

void refuse_unless_regular(const std::filesystem::path& path) {
  std::error_code error;
  switch (std::filesystem::symlink_status(path, error).type()) {
    case std::filesystem::file_type::none:
      throw_file_error("read", path, error.value());
    case std::filesystem::file_type::not_found:
    case std::filesystem::file_type::regular:
      return;
    case std::filesystem::file_type::symlink:
      throw FileError(
          fmt::format("'{}' is a link, through which nothing is written; remove it or put the file "
                      "in its place",
                      path.string()));
    default:
      throw FileError(fmt::format("'{}' is not a regular file; remove it", path.string()));
  }
}

std::string read_file(const std::filesystem::path& path) {
  constexpr std::uintmax_t most = std::uintmax_t{1} << 32;
  return content_of_regular_file(path.string(), most);
}

void read_pieces(const std::filesystem::path& path,
                 const std::function<void(std::string_view)>& take) {
  read_regular_file(path.string(), std::numeric_limits<std::uintmax_t>::max(), take);
}

void write_new_file(const std::filesystem::path& path, std::string_view content) {
  write_to(path, O_CREAT | O_EXCL, content);
}

void overwrite_beginning(const std::filesystem::path& path, std::string_view content) {
  write_to(path, 0, content);
}

void make_directory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw_file_error("make the directory", path, error.value());
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) throw_file_error("replace", to, errno);
}

void remove_file(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::remove(path, error);
  if (error) throw_file_error("remove", path, error.value());
}

void replace_file(const std::filesystem::path& path, std::string_view content) {
  const auto temporary = temporary_name(path);
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  const RemovedUnlessRenamed remover(temporary);
  write_new_file(temporary, content);
  rename_file(temporary, path);
}

void sync_to_disk(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw_file_error("open", path, errno);
  const int status = fsync(file);
  const int error_number = errno;
  close(file);
  if (status != 0) throw_file_error("write", path, error_number);
}

}  // namespace meniscus
