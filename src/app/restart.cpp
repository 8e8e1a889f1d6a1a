// SPDX-License-Identifier: BSD-3-Clause
// Reads a checkpoint to continue from, and compares the scene with the scene that wrote it.
#include "app/restart.hpp"

#include "input/input.hpp"
#include "input/text.hpp"
#include "io/files.hpp"
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

namespace meniscus {
namespace {

/// True if a key changes the simulated physics.
bool is_physics(const std::string& key) {
  for (const std::string_view table : {"title", "initial", "time", "output", "expect"})
    if (key == table || key.starts_with(std::string(table) + ".")) return false;
  return true;
}

/// True if a key changes the arrays that a frame contains.
bool is_frame_layout(const std::string& key) {
  return key.starts_with("output.fields") || key == "output.precision";
}

std::vector<std::string> filtered(const std::vector<std::string>& keys,
                                  bool (*keep)(const std::string&)) {
  std::vector<std::string> kept;
  std::copy_if(keys.begin(), keys.end(), std::back_inserter(kept), keep);
  return kept;
}

/// The run directory that a path names: the path itself, or the directory of a file.
std::filesystem::path run_of(const std::filesystem::path& path) {
  if (is_directory_there(path)) return path;
  return path.has_parent_path() ? path.parent_path() : ".";
}

}  // namespace

std::filesystem::path output_directory(const RunRequest& request) {
  if (!request.output.empty()) return request.output;
  if (!request.restart.empty() && is_directory_there(request.restart)) return request.restart;
  return std::filesystem::path("results") / std::filesystem::path(request.scene).stem();
}

std::optional<Restart> read_restart(const RunRequest& request, const std::string& input) {
  if (request.restart.empty()) return std::nullopt;
  std::optional<ReadCheckpoint> from;
  on_each_rank([&] { from = read_checkpoint(request.restart, request.frame); });
  require_alike(fmt::format("{:016x}", from->checkpoint.state.hash()),
                fmt::format("state of '{}'", from->file.string()));
  const std::filesystem::path output = output_directory(request);
  bool in_place = false;
  on_first_rank([&] { in_place = are_same(run_of(request.restart), output); });
  Restart restart{*std::move(from), ranks().largest(in_place ? 1 : 0) == 1};
  const std::vector<std::string> changed = differing_keys(restart.from.checkpoint.input, input);
  if (const auto keys = filtered(changed, is_physics); !keys.empty())
    throw InputError(fmt::format(
        "'{}' was written by another scene: {} differ{}; continue it with the scene it was written "
        "by; only [time], [output], [expect] and the title may change",
        restart.from.file.string(), joined(keys, ", "), keys.size() == 1 ? "s" : ""));
  if (const auto keys = filtered(changed, is_frame_layout); restart.in_place && !keys.empty())
    throw FileError(
        fmt::format("cannot continue the run in '{}': its frames have another {}; choose the same, "
                    "or another directory with --output",
                    output.string(), joined(keys, ", ")));
  return restart;
}

}  // namespace meniscus
