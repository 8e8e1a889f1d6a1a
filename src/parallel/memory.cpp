// SPDX-License-Identifier: BSD-3-Clause
// Memory use and limits, read from Linux.
#include "parallel/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace meniscus {
namespace {

constexpr Real unlimited = std::numeric_limits<Real>::infinity();

/// The number that follows `word` in a file of the system; infinite if there is none.
Real number_behind(const char* file, const std::string& word) {
  std::ifstream in(file);
  for (std::string found; in >> found;)
    if (Real value = 0; found == word && in >> value) return value;
  return unlimited;
}

Real only_number(const char* file) {
  std::ifstream in(file);
  Real value = 0;
  return in >> value ? value : unlimited;
}

/// Number of bytes that are left until the limit of the address space.
Real left_of_addresses() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  const Real pages = only_number("/proc/self/statm"),
             used = pages * static_cast<Real>(sysconf(_SC_PAGESIZE));
  return used < unlimited ? static_cast<Real>(limit.rlim_cur) - used : unlimited;
}

Real left_of_control_group() {
  const Real most = only_number("/sys/fs/cgroup/memory.max"),
             used = only_number("/sys/fs/cgroup/memory.current");
  return used < unlimited ? most - used : unlimited;
}

}  // namespace

Real available_memory() {
  const Real free = 1024 * number_behind("/proc/meminfo", "MemAvailable:");
  return std::max(0.0, std::min({free, left_of_addresses(), left_of_control_group()}));
}

Real peak_memory() {
  const Real since_forgotten = 1024 * number_behind("/proc/self/status", "VmHWM:");
  if (since_forgotten < unlimited) return since_forgotten;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<Real>(usage.ru_maxrss);
}

void forget_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << 5;
}

}  // namespace meniscus
