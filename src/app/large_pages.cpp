// SPDX-License-Identifier: BSD-3-Clause
// Memory in pages of 2 MB: the system takes a third of the set-up of a small body to fill small
// ones with zeros, one by one (performance note 6).
#include "meniscus/app/large_pages.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace meniscus {

void begin_with_large_pages(char** argv) {
  // The C library reads this where a program begins, and at no other time.
  constexpr const char* settings = "GLIBC_TUNABLES";
  if (std::getenv(settings) != nullptr) return;
  setenv(settings, "glibc.malloc.hugetlb=1", 1);
  // By its name, which the system lists processes by. If this comes back, pages stay small.
  std::error_code error;
  execv(std::filesystem::read_symlink("/proc/self/exe", error).c_str(), argv);
}

}  // namespace meniscus
