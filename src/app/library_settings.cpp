// SPDX-License-Identifier: BSD-3-Clause
// Settings of glibc and OpenMP (measurements in performance note 6). Large memory pages shorten the
// set-up by up to a third. Idle threads spin for a short time before they sleep: without spinning,
// steps of a small body take a quarter longer; with the default of some milliseconds, two runs that
// share the cores are several times slower.
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
  // Restart the program with these settings, under its real name so that process lists show it. If
  // the restart fails, the run continues without the settings.
  std::error_code error;
  execv(std::filesystem::read_symlink("/proc/self/exe", error).c_str(), argv);
}

}  // namespace meniscus
