// SPDX-License-Identifier: BSD-3-Clause
// Stages of a scene: their directories, and where a restart goes on.
#include "app/stages.hpp"

#include "app/outputs.hpp"
#include "app/print.hpp"
#include "app/restart.hpp"
#include "app/set_up.hpp"
#include "io/files.hpp"
#include "io/run_directory.hpp"
#include "meniscus/error.hpp"
#include "parallel/ranks.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {
namespace {

SceneInput scene_of(const RunRequest& of_stage) {
  std::optional<SceneInput> input;
  on_each_rank(
      [&] { input.emplace(SceneInput::from_file(of_stage.scene, of_stage.set, of_stage.stage)); });
  return *input;
}

template <int D>
void require_buildable(const SceneInput& input) {
  const Scene<D> scene = set_up(input, [&] { return build_scene<D>(input); });
  require_known_outputs(input, scene);
}

void refuse_options_of_one_stage(const RunRequest& request) {
  if (!request.beside.empty())
    throw InputError("--beside is for a scene without stages; leave it out");
  const std::string option = !request.until.empty() ? "--until" : request.frame ? "--frame" : "";
  if (!option.empty())
    throw InputError(fmt::format(
        "{} is for a scene without stages: the time of each stage begins at 0; allowed is a "
        "smaller end of a stage, such as --set stage.NAME.time.end=1",
        option));
}

/// Number of the stage with which a run begins: the last one with a state to restart from.
std::size_t first_stage(const RunRequest& request, const std::vector<std::string>& names) {
  std::size_t first = 0;
  on_first_rank([&] {
    for (std::size_t k = 0; k < names.size(); ++k)
      if (has_checkpoint(std::filesystem::path(request.restart) / names[k])) first = k;
  });
  return static_cast<std::size_t>(ranks().largest(static_cast<std::int64_t>(first)));
}

}  // namespace

bool has_checkpoint(const std::filesystem::path& directory) {
  return is_there(directory / "checkpoint-a.h5") || is_there(directory / "checkpoint-b.h5");
}

RunRequest request_of_stage(const RunRequest& all, const std::vector<std::string>& names,
                            std::size_t number, const std::filesystem::path& directory) {
  RunRequest one = all;
  one.stages = directory.string();
  one.output = (directory / at(names, number)).string();
  one.stage = {at(names, number),
               number == 0 ? std::string() : (directory / at(names, number - 1)).string()};
  return one;
}

int run_stages(const RunRequest& request, const std::vector<std::string>& names,
               const RunOne& run_one) {
  refuse_options_of_one_stage(request);
  const std::filesystem::path directory = output_directory(request);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const SceneInput input = scene_of(request_of_stage(request, names, k, directory));
    scene_dimension(input) == 2 ? require_buildable<2>(input) : require_buildable<3>(input);
  }
  const bool anew = request.restart.empty();
  if (anew)  // a later restart must not find states of an earlier run
    on_first_rank([&] {
      for (const std::string& name : names)
        RunDirectory(directory / name,
                     request.overwrite ? ExistingRun::replace : ExistingRun::refuse);
    });
  const std::size_t first = anew ? 0 : first_stage(request, names);
  int worst = exit_ok;
  for (std::size_t k = first; k < names.size(); ++k) {
    RunRequest one = request_of_stage(request, names, k, directory);
    one.restart =
        anew || k > first ? "" : (std::filesystem::path(request.restart) / names[k]).string();
    one.overwrite = true;
    if (!request.quiet) say("stage {} of {}: {}\n", k + 1, names.size(), names[k]);
    const int code = run_one(scene_of(one), one);
    if (code != exit_ok && code != exit_expectation) return code;
    worst = std::max(worst, code);
  }
  return worst;
}

}  // namespace meniscus
