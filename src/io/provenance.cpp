// SPDX-License-Identifier: BSD-3-Clause
// Collects the provenance of a result.
#include "io/provenance.hpp"

#include "io/hdf5_file.hpp"
#include "meniscus_version.hpp"

#include <fmt/core.h>
#include <omp.h>

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <string_view>

namespace meniscus {
namespace {

std::string compiler() {
#ifdef __clang__
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

std::string utc(std::time_t time) {
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace

Build build() {
  return {version::number,
          version::git_hash,
          version::git_dirty,
          compiler(),
          MENISCUS_BUILD_FLAGS,
          {{"Eigen",
            fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
           {"HDF5", hdf5::library_version()},
           {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                               FMT_VERSION % 100)},
           {"OpenMP", fmt::format("{}", _OPENMP)}}};
}

std::string program_text(const Build& b) {
  return fmt::format("meniscus {} ({}{}), {}, {}", b.version, b.git_hash.substr(0, 12),
                     b.git_dirty ? " with changes" : "", b.compiler, b.flags);
}

Provenance provenance(std::string command_line, std::string input) {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return {build(), omp_get_max_threads(), std::move(command_line), std::move(input), utc(now)};
}

std::string portable_command_line(int argc, const char* const* argv) {
  std::string line;
  for (int i = 0; i < argc; ++i) {
    std::string_view argument = argv[i];
    std::string option;
    if (argument.starts_with("--"))
      if (const auto equal = argument.find('='); equal != argument.npos) {
        option = argument.substr(0, equal + 1);
        argument.remove_prefix(equal + 1);
      }
    // A path such as "/a/b/" has an empty file name.
    std::string shown(argument);
    if (argument.starts_with('/')) {
      while (shown.size() > 1 && shown.ends_with('/')) shown.pop_back();
      shown = std::filesystem::path(shown).filename();
    }
    line += (i ? " " : "") + option + shown;
  }
  return line;
}

}  // namespace meniscus
