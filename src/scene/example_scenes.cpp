// SPDX-License-Identifier: BSD-3-Clause
// Builds small scenes around the examples of registered items.
#include "scene/example_scenes.hpp"

#include <fmt/core.h>

namespace meniscus {

std::string example_liquid() {
  return "material = { type = \"newtonian\", density = 1, bulk_modulus = 20, viscosity = 0.3 }\n";
}

std::string example_nematic(int D) {
  return std::string(
             "[body.material]\ntype = \"nematic\"\ndensity = 1\nbulk_modulus = 20\nviscosity = "
             "0.3\nfrank_constant = 0.2\ncore_length = 0.6\nrotational_viscosity = "
             "0.5\ninitial_director = ") +
         (D == 3 ? "[\"0.6 + 0.2*y\", \"-0.1*x*z\", \"-0.8\"]\n"
                 : "[\"0.6 + 0.2*y\", \"0.8 - 0.1*x\"]\n");
}

std::string example_solid() {
  return "material = { type = \"neo_hookean\", density = 1, mu = 3, lambda = 10 }\n";
}

std::string example_ball(int D, const std::string& name) {
  return fmt::format("[[body]]\nname = \"{}\"\n{}", name,
                     D == 3 ? "shape = \"ball\"\nradius = 1\ncore = 2\nlayers = 2\n"
                            : "shape = \"disk\"\nradius = 1\ncore = 6\nrings = 3\n");
}

std::string one_drop(int D) {
  return example_ball(D, "drop") + example_liquid();
}

std::string two_drops(int D) {
  return one_drop(D) + example_ball(D, "other") +
         (D == 3 ? "centre = [2.2, 0, 0]\ninitial_velocity = [\"-0.2\", 0, 0]\n"
                 : "centre = [2.2, 0]\ninitial_velocity = [\"-0.2\", 0]\n") +
         example_solid();
}

std::string sessile_drop(int D, const std::string& lines) {
  return std::string("[[body]]\nname = \"drop\"\n") +
         (D == 3 ? "shape = \"half_sphere\"\nradius = 1\ncore = 4\nlayers = 2\n"
                 : "shape = \"half_disk\"\nradius = 1\ncore = 6\nrings = 3\n") +
         example_liquid() + lines +
         "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\ncoefficient_damping = 0\n";
}

std::string one_shell() {
  return "[[body]]\nname = \"shell\"\nshape = \"disk_shell\"\nradius = 2\n"
         "height = 1.6\nthickness = 0.4\nspacing = 0.6\n" +
         example_solid();
}

std::string example_heading(int D, const std::string& time) {
  return fmt::format("dimension = {}\n[time]\nend = 1e3\ncheck_every = 20\n{}", D, time);
}

std::string revolved_heading(const std::string& time) {
  return "dimension = \"axisymmetric\"\n[time]\nend = 1e3\ncheck_every = 20\n" + time;
}

std::string scene_with_load(int D, const std::string& name, const std::string& lines) {
  const auto named = [&](const char* body) { return lines.find(body) != std::string::npos; };
  const bool shell = named("\"shell\"");
  const std::string bodies = shell                ? one_shell()
                             : named("\"other\"") ? two_drops(D)
                             : named("\"flat\"")  ? sessile_drop(D)
                                                  : one_drop(D);
  return (D == 2 && shell ? revolved_heading() : example_heading(D)) + bodies + "[[" + name +
         "]]\n" + lines;
}

std::string legacy_contact(int D) {
  return std::string(
             "bodies = [\"drop\"]\ninteraction = \"legacy_switch\"\ncontact_angle = 60\n"
             "adhesion = 1\nsigma0 = 0.3\nswitch_gap = 0.7\n"
             "[contact.partner]\ntype = \"half_space\"\n") +
         (D == 3 ? "point = [0, 0, -1.15]\nnormal = [0, 0, 1]\n"
                 : "point = [0, -1.15]\nnormal = [0, 1]\n") +
         "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\nform = \"triangles\"\n";
}

}  // namespace meniscus
