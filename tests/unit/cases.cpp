// SPDX-License-Identifier: BSD-3-Clause
// The cases of everything registered.
#include "cases.hpp"

#include "meniscus/body/shapes.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "meniscus/physics/surface_registry.hpp"
#include "meniscus/solve/stepper.hpp"

#include <fmt/core.h>

namespace meniscus::test {

namespace {

std::string heading(int D, const std::string& time = "") {
  return fmt::format("dimension = {}\n[time]\nend = 1e3\ncheck_every = 20\n{}", D, time);
}

constexpr const char* liquid =
    "material = { type = \"newtonian\", density = 1, bulk_modulus = 20, viscosity = 0.3 }\n";
constexpr const char* solid =
    "material = { type = \"neo_hookean\", density = 1, mu = 3, lambda = 10 }\n";

std::string ball(int D, const std::string& name) {
  return fmt::format("[[body]]\nname = \"{}\"\n{}", name,
                     D == 3 ? "shape = \"ball\"\nradius = 1\ncore = 2\nlayers = 2\n"
                            : "shape = \"disk\"\nradius = 1\ncore = 6\nrings = 3\n");
}

/// The bodies that the lines of a load name.
std::string bodies_for(int D, const std::string& lines) {
  if (lines.find("\"shell\"") != std::string::npos) return one_shell();
  return lines.find("\"other\"") != std::string::npos ? two_drops(D) : one_drop(D);
}

std::string with_load(int D, const std::string& name, const std::string& lines) {
  return heading(D) + bodies_for(D, lines) + "[[" + name + "]]\n" + lines;
}

/// A motion without symmetry.
std::string moving(int D) {
  return D == 3 ? "initial_velocity = [\"0.1*y\", \"-0.2*x\", \"0.1*z + 0.05\"]\n"
                : "initial_velocity = [\"0.1*y\", \"-0.2*x + 0.05\"]\n";
}

/// More than one example is worth a test, or more is claimed than of any load.
std::vector<Case> variants(int D) {
  const Claims all{true, true}, none;
  std::vector<Case> cases;
  const auto add = [&](const std::string& load, const std::string& variant,
                       const std::string& lines, Claims claims) {
    cases.push_back({"load " + load + ", " + variant, with_load(D, load, lines), claims});
  };
  const std::string tension = "body = \"drop\"\ngamma = 1\nform = ";
  add("surface_tension", "balanced", tension + "\"balanced\"\ncoefficient_damping = 0\n", all);
  add("surface_tension", "weak", tension + "\"weak\"\n", all);
  add("surface_tension", "curvature", tension + "\"curvature\"\n", none);
  add("surface_tension", "triangles", tension + "\"triangles\"\n", all);
  const std::string cavity = "body = \"drop\"\nsurface = \"outer\"\n";
  add("cavity", "pressure", cavity + "pressure = 0.3\n", all);
  add("cavity", "content", cavity + "volume_target = 0.9\npenalty = 2\nramp = [0, 0.2]\n", all);
  const std::string pair =
      "bodies = [\"drop\", \"other\"]\nepsilon = 1\nsigma0 = 0.3\nbeta = 1\nskin = 10\n";
  add("contact", "energy", pair, all);
  add("contact", "pressure", pair + "form = \"pressure\"\n", none);
  // The force of the cut-off law jumps where its switch begins and ends: here far away.
  add("contact", "volume", pair + "form = \"volume\"\ncutoff = 20\n", all);
  // Contact on the patches of the tension.
  const std::string on_patches =
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\ncoefficient_damping = 0\n";
  const std::string young = "interaction = \"smooth_young\"\noffset = 0.2\nrange = 0.3\n";
  cases.push_back({"contact of patches with a partner",
                   with_load(D, "contact",
                             "bodies = [\"drop\"]\ncontact_angle = 80\n" + young +
                                 "[contact.partner]\ntype = \"half_space\"\n" +
                                 (D == 3 ? "point = [0, 0, -1.25]\nnormal = [0, 0, 1]\n"
                                         : "point = [0, -1.25]\nnormal = [0, 1]\n") +
                                 on_patches),
                   {true, false}});
  cases.push_back(
      {"Lennard-Jones contact of patches", with_load(D, "contact", pair + on_patches), all});
  cases.push_back({"implicit viscosity",
                   heading(D, "viscosity = \"implicit\"\n") + ball(D, "drop") + moving(D) + liquid +
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
  add("contact", "legacy_switch",
      std::string("bodies = [\"drop\"]\ninteraction = \"legacy_switch\"\ncontact_angle = 60\n"
                  "adhesion = 1\nsigma0 = 0.3\nswitch_gap = 0.7\n"
                  "[contact.partner]\ntype = \"half_space\"\n") +
          (D == 3 ? "point = [0, 0, -1.15]\nnormal = [0, 0, 1]\n"
                  : "point = [0, -1.15]\nnormal = [0, 1]\n") +
          "[[surface_tension]]\n" + tension + "\"triangles\"\n",
      {});
  return cases;
}

template <int D>
std::vector<Case> all_cases() {
  std::vector<Case> cases = variants(D);
  for (const auto& [name, load] : loads<D>())
    if (!load.example.empty())
      cases.push_back(
          {"load " + name, with_load(D, name, std::string(load.example)), {true, false}});
  for (const auto& [name, law] : surface_laws())
    if (!law.example.empty())
      cases.push_back({"surface law " + name,
                       with_load(D, "surface",
                                 fmt::format("body = \"drop\"\n[surface.law]\ntype = \"{}\"\n{}",
                                             name, law.example)),
                       {true, true}});
  // legacy_switch needs a plane and a tension: a variant above.
  const auto generic = [](const std::string& name, const auto& by) {
    return !by.example.empty() && name != "legacy_switch";
  };
  for (const auto& [name, by] : interactions<D>())
    if (generic(name, by))
      cases.push_back(
          {"interaction " + name,
           with_load(D, "contact",
                     fmt::format("bodies = [\"drop\", \"other\"]\ninteraction = \"{}\"\n{}", name,
                                 by.example)),
           {true, true}});
  for (const auto& [interaction, by] : interactions<D>())
    for (const auto& [name, partner] : partners<D>())
      if (generic(interaction, by) && !partner.example.empty())
        cases.push_back(
            {"partner " + name + " by interaction " + interaction,
             with_load(
                 D, "contact",
                 fmt::format("bodies = [\"drop\"]\ninteraction = \"{}\"\n{}[contact.partner]\n"
                             "type = \"{}\"\n{}",
                             interaction, by.example, name, partner.example)),
             {true, false}});
  for (const auto& [name, law] : laws()) {
    std::string material = "[body.material]\ntype = \"" + name + "\"\n" + law.example;
    for (const KeyText& key : law.keys)
      if (key.key == "reference_director")
        material +=
            D == 3 ? "reference_director = [0.6, 0, -0.8]\n" : "reference_director = [0.6, 0.8]\n";
    cases.push_back({"material " + name,
                     heading(D) + ball(D, "ball") + moving(D) + material,
                     {true, true},
                     true});
  }
  for (const auto& [name, shape] : shapes<D>())
    if (!shape.example.empty())
      cases.push_back({"shape " + name,
                       heading(D) + "[[body]]\nname = \"body\"\nshape = \"" + name + "\"\n" +
                           std::string(shape.example) + moving(D) + solid,
                       {true, true},
                       true});
  for (const auto& [name, solver] : Registry<StepperEntry>::all())
    cases.push_back(
        {"solver " + name,
         heading(D, "solver = \"" + name + "\"\n") + ball(D, "ball") + moving(D) + solid,
         {true, true},
         true});
  return cases;
}

}  // namespace

std::string one_drop(int D) {
  return ball(D, "drop") + liquid;
}

std::string two_drops(int D) {
  return one_drop(D) + ball(D, "other") +
         (D == 3 ? "centre = [2.2, 0, 0]\ninitial_velocity = [\"-0.3\", 0, 0]\n"
                 : "centre = [2.2, 0]\ninitial_velocity = [\"-0.3\", 0]\n") +
         solid;
}

std::string one_shell() {
  return std::string(
             "[[body]]\nname = \"shell\"\nshape = \"disk_shell\"\nradius = 2\n"
             "height = 1.6\nthickness = 0.4\nspacing = 0.6\n") +
         solid;
}

template <int D>
const std::vector<Case>& cases() {
  static const std::vector<Case> all = all_cases<D>();
  return all;
}
template const std::vector<Case>& cases<2>();
template const std::vector<Case>& cases<3>();

}  // namespace meniscus::test
