// SPDX-License-Identifier: BSD-3-Clause
// Test cases for everything registered.
#include "cases.hpp"

#include "meniscus/body/shapes.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "meniscus/physics/surface_registry.hpp"
#include "meniscus/solve/stepper.hpp"
#include "mesh_support.hpp"
#include "revolved_cases.hpp"
#include "support.hpp"

#include <fmt/core.h>

namespace meniscus::test {

namespace {

/// A motion without symmetry.
std::string moving(int D) {
  return D == 3 ? "initial_velocity = [\"0.1*y\", \"-0.2*x\", \"0.1*z + 0.05\"]\n"
                : "initial_velocity = [\"0.1*y\", \"-0.2*x + 0.05\"]\n";
}

std::string nematic_drop(int D) {
  return example_heading(D) + example_ball(D, "drop") + moving(D) + example_nematic(D);
}

/// Additional scenes: for loads and laws that one example does not cover, and for loads whose
/// forces have more or fewer properties than the default. `Claims` lists the properties that are
/// tested.
std::vector<Case> variants(int D) {
  const Claims all{true, true}, none;
  std::vector<Case> cases;
  const auto add = [&](const std::string& load, const std::string& variant,
                       const std::string& lines, Claims claims) {
    cases.push_back({"load " + load + ", " + variant, scene_with_load(D, load, lines), claims});
  };
  const std::string tension = "body = \"drop\"\ngamma = 1\nform = ";
  add("surface_tension", "balanced", tension + "\"balanced\"\ncoefficient_damping = 0\n", all);
  add("surface_tension", "weak", tension + "\"weak\"\n", all);
  add("surface_tension", "curvature", tension + "\"curvature\"\n", none);
  add("surface_tension", "triangles", tension + "\"triangles\"\n", all);
  const std::string cavity = "body = \"drop\"\nsurface = \"outer\"\n";
  add("cavity", "pressure", cavity + "pressure = 0.3\n", all);
  add("cavity", "content", cavity + "volume_target = 0.9\npenalty = 2\nramp = [0, 0.2]\n", all);
  add("area", "kept", "body = \"drop\"\nmodulus = 3\n", all);
  add("viscoelasticity", "of a liquid", "body = \"drop\"\nmoduli = [0.5]\ntimes = [0.1]\n", all);
  add("spring", "moved by a ramp",
      std::string("body = \"drop\"\nwhere = \"y > 0.8\"\nstiffness = 3\nramp = [0, 0.2]\n") +
          (D == 3 ? "displacement = [0.1, \"0.2*x\", 0.05]\n"
                  : "displacement = [0.1, \"0.2*x\"]\n"),
      {true, false});
  const std::string pair =
      "bodies = [\"drop\", \"other\"]\nepsilon = 1\nsigma0 = 0.3\nbeta = 1\nskin = 10\n";
  add("contact", "energy", pair, all);
  add("contact", "pressure", pair + "form = \"pressure\"\n", none);
  // The force of the cut-off law jumps at both ends of its switch; here the switch is far away.
  add("contact", "volume", pair + "form = \"volume\"\ncutoff = 20\n", all);
  // Contact points on the patches of the surface tension.
  const std::string on_patches =
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\ncoefficient_damping = 0\n";
  const std::string young = "interaction = \"smooth_young\"\noffset = 0.2\nrange = 0.3\n";
  cases.push_back({"contact of patches with a partner",
                   scene_with_load(D, "contact",
                                   "bodies = [\"drop\"]\ncontact_angle = 80\n" + young +
                                       "[contact.partner]\ntype = \"half_space\"\n" +
                                       (D == 3 ? "point = [0, 0, -1.25]\nnormal = [0, 0, 1]\n"
                                               : "point = [0, -1.25]\nnormal = [0, 1]\n") +
                                       on_patches),
                   {true, false}});
  cases.push_back(
      {"Lennard-Jones contact of patches", scene_with_load(D, "contact", pair + on_patches), all});
  cases.push_back({"implicit viscosity",
                   example_heading(D, "viscosity = \"implicit\"\n") + example_ball(D, "drop") +
                       moving(D) + example_liquid() +
                       "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n",
                   {false, false},
                   true});
  add("contact", "adhesion by formulas, friction",
      std::string("bodies = [\"drop\"]\nadhesion = \"0.3 + 0.1*x + 0.05*sin(40*t)\"\n"
                  "actin = \"0.1*y\"\noffset = 0.2\nrange = 0.3\nfriction = 0.4\n"
                  "[contact.partner]\ntype = \"ball\"\nradius = 0.7\n") +
          (D == 3 ? "centre = [0, 0.2, -2]\ndisplacement = [\"0.1*t\", 0, 0]\n"
                  : "centre = [0.2, -2]\ndisplacement = [\"0.1*t\", 0]\n"),
      {});
  // With three points per direction, the force on the node where the coarse bodies meet is too
  // small for the test.
  add("contact", "actin between bodies",
      "bodies = [\"drop\", \"other\"]\nadhesion = 0.3\nactin = \"0.1*sin(40*t)\"\n"
      "offset = 0.2\nrange = 0.3\nskin = 10\npoints = 4\n",
      all);
  add("contact", "actin on ground",
      std::string("bodies = [\"drop\", \"other\"]\nadhesion = 0.3\nactin = \"0.1*sin(40*t)\"\n"
                  "offset = 0.2\nrange = 0.3\nskin = 10\nup = ") +
          (D == 3 ? "[-1, 0.1, 0]\n" : "[-1, 0.1]\n"),
      {true, false});
  const std::string bent = D == 3 ? "map = [\"x\", \"y\", \"z + sqrt(4 - x^2 - y^2) - 2\"]\n"
                                  : "map = [\"x\", \"y + sqrt(4 - x^2) - 2\"]\n";
  cases.push_back({"load wetted, on a ball",
                   example_heading(D) + sessile_drop(D, bent + moving(D)) +
                       "[[wetted]]\nbody = \"drop\"\nface = \"flat\"\ntension = 0.3\n"
                       "[[body_force]]\nbody = \"drop\"\nacceleration = " +
                       (D == 3 ? "[0.1, 0, -0.5]\n" : "[0.1, -0.5]\n"),
                   {},
                   true});
  cases.push_back({"load wetted, pinned",
                   example_heading(D) + sessile_drop(D, moving(D)) +
                       "[[wetted]]\nbody = \"drop\"\nface = \"flat\"\nadvancing_angle = "
                       "91\nreceding_angle = 89\n",
                   {},
                   true});
  cases.push_back(
      {"load wetted, on a wall that moves",
       example_heading(D) + sessile_drop(D, moving(D)) +
           "[[wetted]]\nbody = \"drop\"\nface = \"flat\"\ncontact_angle = 70\n"
           "line_friction = 0.3\ndisplacement = " +
           (D == 3 ? "[\"0.1*t\", 0, \"0.05*sin(20*t)\"]\n" : "[\"0.1*t\", \"0.05*sin(20*t)\"]\n"),
       {},
       true});
  // A plane that a force and a spring press against the drop.
  const std::string pressed =
      std::string("[contact.partner]\ntype = \"half_space\"\n") +
      (D == 3 ? "point = [0, 0, -1.25]\nnormal = [0, 0.1, 1]\ndirection = [0.1, 0, 1]\n"
              : "point = [0, -1.25]\nnormal = [0.1, 1]\ndirection = [0, 1]\n") +
      "force = \"0.2 + 0.1*sin(30*t)\"\nstiffness = 0.5\nbase = \"0.1*t\"\n";
  add("contact", "pressed partner", "bodies = [\"drop\"]\nadhesion = 0.3\n" + pressed,
      {true, false});
  add("contact", "Lennard-Jones, pressed partner",
      "bodies = [\"drop\"]\nepsilon = 1\nsigma0 = 0.3\nbeta = 1\n" + pressed, {true, false});
  add("contact", "legacy_switch", legacy_contact(D), {});
  add("surface", "tension by place",
      "body = \"drop\"\n[surface.law]\ntype = \"varying_tension\"\nof = \"place\"\n"
      "gamma = \"1 + 0.1*x + 0.2*y*sin(3*t)\"\n",
      none);
  return cases;
}

template <int D>
std::vector<Case> all_cases() {
  const Claims all{true, true}, none;  // a purely viscous surface law has no force at rest
  std::vector<Case> cases = variants(D);
  for (const auto& [name, load] : loads<D>())
    if (!load.example.empty())
      cases.push_back(
          {"load " + name, scene_with_load(D, name, std::string(load.example)), {true, false}});
  for (const auto& [name, law] : surface_laws())
    if (!law.example.empty()) {
      const std::string surface =
          fmt::format("body = \"drop\"\n[surface.law]\ntype = \"{}\"\n{}", name, law.example);
      if (name != "anchoring")
        cases.push_back({"surface law " + name, scene_with_load(D, "surface", surface),
                         name == "boussinesq_scriven" ? none : all});
      else  // needs a director, and its reaction for the balance of torque
        cases.push_back({"surface law " + name,
                         nematic_drop(D) + "[[surface]]\n" + surface,
                         {true, false},
                         true});
    }
  // legacy_switch needs a plane and a tension: see variants().
  const auto generic = [](const std::string& name, const auto& by) {
    return !by.example.empty() && name != "legacy_switch";
  };
  for (const auto& [name, by] : interactions<D>())
    if (generic(name, by))
      cases.push_back(
          {"interaction " + name,
           scene_with_load(D, "contact",
                           fmt::format("bodies = [\"drop\", \"other\"]\ninteraction = \"{}\"\n{}",
                                       name, by.example)),
           {true, true}});
  for (const auto& [interaction, by] : interactions<D>())
    for (const auto& [name, partner] : partners<D>())
      if (generic(interaction, by) && !partner.example.empty())
        cases.push_back(
            {"partner " + name + " by interaction " + interaction,
             scene_with_load(
                 D, "contact",
                 fmt::format("bodies = [\"drop\"]\ninteraction = \"{}\"\n{}[contact.partner]\n"
                             "type = \"{}\"\n{}",
                             interaction, by.example, name, partner.example)),
             {true, false}});
  for (const auto& [name, law] : laws()) {
    std::string material = "[body.material]\ntype = \"" + name + "\"\n" + law.example;
    for (const KeyText& key : law.keys()) {
      if (key.key == "reference_director")
        material +=
            D == 3 ? "reference_director = [0.6, 0, -0.8]\n" : "reference_director = [0.6, 0.8]\n";
    }
    if (name != "nematic")
      cases.push_back({"material " + name,
                       example_heading(D) + example_ball(D, "ball") + moving(D) + material,
                       {true, true},
                       true});
    else
      cases.push_back({"material " + name, nematic_drop(D), {true, false}, true});
    if (name == "liquid_crystal_elastomer")
      cases.push_back({"material " + name + ", active",
                       example_heading(D) + example_ball(D, "ball") + moving(D) + material +
                           "activity = 0.3\nactivity_ramp = [0, 0.2]\n",
                       {true, true},
                       true});
  }
  // Mesh files named in examples, with tetrahedra and triangles.
  const Grid<D> grid = test::brick<D>(std::vector<Real>(D, 3), 0.2).grid;
  write_example(D == 3 ? "block.msh" : "plate.msh", msh_of<D>(grid, simplices_of(grid)));
  for (const auto& [name, shape] : shapes<D>())
    if (!shape.example.empty())
      cases.push_back({"shape " + name,
                       example_heading(D) + "[[body]]\nname = \"body\"\nshape = \"" + name +
                           "\"\n" + std::string(shape.example) + moving(D) + example_solid(),
                       {true, true},
                       true});
  for (const auto& [name, solver] : Registry<StepperEntry>::all())
    cases.push_back({"solver " + name,
                     example_heading(D, "solver = \"" + name + "\"\n") + example_ball(D, "ball") +
                         moving(D) + example_solid(),
                     {true, true},
                     true});
  if (D == 2)
    for (Case& c : revolved_cases()) cases.push_back(std::move(c));
  return cases;
}

}  // namespace

template <int D>
const std::vector<Case>& cases() {
  static const std::vector<Case> all = all_cases<D>();
  return all;
}
template const std::vector<Case>& cases<2>();
template const std::vector<Case>& cases<3>();

}  // namespace meniscus::test
