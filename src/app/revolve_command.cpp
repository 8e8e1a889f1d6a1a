// SPDX-License-Identifier: BSD-3-Clause
// `meniscus revolve`: writes the twin of a scene in the half plane.
#include "app/commands.hpp"
#include "app/print.hpp"
#include "io/files.hpp"
#include "meniscus/error.hpp"
#include "scene/half_plane_twin.hpp"

#include <fmt/core.h>

namespace meniscus {

void revolve(const RevolveRequest& request) {
  const SceneInput input = SceneInput::from_file(request.scene, request.set);
  if (scene_dimension(input) == 2) {
    input.check();
    throw InputError(input.root().place("dimension") +
                     " is not 3; 3D scenes alone have a twin in the half plane");
  }
  if (!input.stages().empty())
    throw InputError(request.scene + ": has stages; allowed is a scene without [[stage]]");
  const Plan<3> plan = read_plan<3>(input);
  const HalfPlaneTwin twin = half_plane_twin(input, plan);
  std::string text =
      fmt::format("# {} in the half plane of a body of revolution.\n", request.scene);
  for (const std::string& note : twin.notes) text += fmt::format("# {}\n", note);
  text += twin.text;
  if (request.file.empty()) return print_text(text);
  write_new_file(request.file, text);
  Index particles = 0;
  for (const auto& body : plan.bodies) particles += static_cast<Index>(body.geometry.grid.X.size());
  say("{} has {} particles instead of {}; next: meniscus run {}\n", request.file, twin.particles,
      particles, request.file);
}

}  // namespace meniscus
