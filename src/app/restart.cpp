// SPDX-License-Identifier: BSD-3-Clause
// Reading a restart and comparing its scene with that of the run.
#include "meniscus/app/restart.hpp"

#include "meniscus/core/error.hpp"

#include <fmt/format.h>

#include <sstream>

namespace meniscus {
namespace {

/// The lines of a complete input that decide what is simulated: without title, [time], [output],
/// [expect], and without comments (unit; whether a value is the default).
std::string physics_of(const std::string& complete) {
  std::istringstream lines(complete);
  std::string line, kept;
  bool keep = true;
  while (std::getline(lines, line)) {
    if (line.starts_with("["))
      keep = !line.starts_with("[time") && !line.starts_with("[output") &&
             !line.starts_with("[expect");
    if (keep && !line.empty() && !line.starts_with("title = "))
      kept += line.substr(0, line.rfind("  # ")) + "\n";
  }
  return kept;
}

/// The lines of a complete input that decide what a frame consists of.
std::string frame_layout_of(const std::string& complete) {
  std::istringstream lines(complete);
  std::string line, kept;
  while (std::getline(lines, line))
    if (line.starts_with("fields = ") || line.starts_with("precision = "))
      kept += line.substr(0, line.rfind("  # ")) + "\n";
  return kept;
}

/// The directory that a file or directory of a run stands for.
std::filesystem::path run_of(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) return path;
  return path.has_parent_path() ? path.parent_path() : ".";
}

}  // namespace

std::filesystem::path output_directory(const RunRequest& request) {
  if (!request.output.empty()) return request.output;
  if (!request.restart.empty() && std::filesystem::is_directory(request.restart))
    return request.restart;
  return std::filesystem::path("results") / std::filesystem::path(request.scene).stem();
}

std::optional<Restart> read_restart(const RunRequest& request, const std::string& input) {
  if (request.restart.empty()) return std::nullopt;
  const std::filesystem::path output = output_directory(request);
  Restart restart{read_checkpoint(request.restart, request.frame),
                  std::filesystem::exists(output) &&
                      std::filesystem::equivalent(run_of(request.restart), output)};
  if (physics_of(restart.from.checkpoint.input) != physics_of(input))
    throw InputError(fmt::format(
        "'{}' was written by another scene: bodies, materials or loads differ. Continue it with "
        "the "
        "scene it was written by; only [time], [output], [expect] and the title may change.",
        restart.from.file.string()));
  if (restart.in_place && frame_layout_of(restart.from.checkpoint.input) != frame_layout_of(input))
    throw FileError(
        fmt::format("Cannot continue the run in '{}': its frames have other fields or another "
                    "precision. Choose "
                    "the same ones, or another directory with --output.",
                    output.string()));
  return restart;
}

}  // namespace meniscus
