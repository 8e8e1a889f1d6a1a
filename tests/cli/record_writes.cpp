// SPDX-License-Identifier: BSD-3-Clause
// Records every change of a file. Linked into result_writer, it replaces pwrite, ftruncate and
// rename of the C library and writes their effects to the file named by RECORD_WRITES. Each record
// is a line: "write INODE OFFSET SIZE", followed by SIZE bytes and the end of a line, "truncate
// INODE SIZE" or "rename INODE NAME".
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace {

std::FILE* record() {
  static std::FILE* const file = std::fopen(std::getenv("RECORD_WRITES"), "wb");
  return file;
}

unsigned long inode(int descriptor) {
  struct stat status {};
  fstat(descriptor, &status);
  return status.st_ino;
}

}  // namespace

extern "C" {

ssize_t pwrite(int file, const void* bytes, size_t size, off_t offset) {
  std::fprintf(record(), "write %lu %ld %zu\n", inode(file), offset, size);
  std::fwrite(bytes, 1, size, record());
  std::fputc('\n', record());
  return syscall(SYS_pwrite64, file, bytes, size, offset);
}

int ftruncate(int file, off_t size) noexcept {
  std::fprintf(record(), "truncate %lu %ld\n", inode(file), size);
  return static_cast<int>(syscall(SYS_ftruncate, file, size));
}

int rename(const char* from, const char* to) noexcept {
  struct stat status {};
  stat(from, &status);
  std::fprintf(record(), "rename %lu %s\n", status.st_ino, to);
  return static_cast<int>(syscall(SYS_rename, from, to));
}
}
