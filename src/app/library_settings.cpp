// SPDX-License-Identifier: BSD-3-Clause
// Settings of libraries, measured in performance note 6. Small pages, which the system fills with
// zeros one by one, are up to a third of the set-up. Threads that sleep at once make the steps of a
// small body a quarter longer; those that wait for milliseconds, as by default, make two runs that
// share the cores several times as slow.
#include "app/library_settings.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace meniscus {
namespace {

bool is_set(const char* variable) {
  return std::getenv(variable) != nullptr;
}

}  // namespace

void begin_with_settings(char** argv) {
  constexpr const char *memory = "GLIBC_TUNABLES", *waiting = "GOMP_SPINCOUNT";
  const bool sets_memory = !is_set(memory),
             sets_waiting = !is_set(waiting) && !is_set("OMP_WAIT_POLICY");
  if (!sets_memory && !sets_waiting) return;
  if (sets_memory) setenv(memory, "glibc.malloc.hugetlb=1", 1);
  if (sets_waiting) setenv(waiting, "5000", 1);
  // By its name, which the system lists processes by. If this comes back, nothing is set.
  std::error_code error;
  execv(std::filesystem::read_symlink("/proc/self/exe", error).c_str(), argv);
}

}  // namespace meniscus
