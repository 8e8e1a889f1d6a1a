// SPDX-License-Identifier: BSD-3-Clause
// Test cases of bodies of revolution: everything registered that knows them.
#include "revolved_cases.hpp"

#include "cases.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/physics/interaction_registry.hpp"
#include "meniscus/physics/law_registry.hpp"
#include "meniscus/physics/surface_registry.hpp"
#include "meniscus/solve/stepper.hpp"

#include <fmt/core.h>

namespace meniscus::test {
namespace {

/// A motion without symmetry but that about the axis.
constexpr const char* about_axis =
    "initial_velocity = [\"0.1*x*(1 + 0.5*y)\", \"-0.2*y + 0.05 + 0.1*x^2\"]\n";

std::string ball(const std::string& material) {
  return revolved_heading() + example_ball(2, "drop") + about_axis + material;
}

constexpr const char* tension =
    "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\ncoefficient_damping = 0\n";
constexpr const char* plane =
    "[contact.partner]\ntype = \"half_space\"\npoint = [0, -1.25]\nnormal = [0, 1]\n";

/// Interactions with the partners that are of revolution.
void add_contacts(std::vector<Case>& cases) {
  const std::string young =
                        "bodies = [\"drop\"]\ncontact_angle = 80\n"
                        "interaction = \"smooth_young\"\noffset = 0.2\nrange = 0.3\n",
                    adhesive = "bodies = [\"drop\"]\nadhesion = 0.3\noffset = 0.2\nrange = 0.3\n",
                    particles = "bodies = [\"drop\"]\nepsilon = 1\nsigma0 = 0.3\nbeta = 1\n",
                    round = "[contact.partner]\ntype = \"ball\"\ncentre = [0, -2]\nradius = 0.7\n",
                    around =
                        "[contact.partner]\ntype = \"cavity\"\ncentre = [0, 0.1]\nradius = 1.4\n";
  const auto add = [&](const std::string& name, const std::string& material,
                       const std::string& lines) {
    cases.push_back(
        {"revolved contact " + name, ball(material) + "[[contact]]\n" + lines, {true, false}});
  };
  add("of patches", example_liquid(), young + plane + tension);
  add("of a solid by smooth_young", example_solid(), adhesive + plane);
  for (const auto& [name, partner] : {std::pair("plane", std::string(plane)),
                                      std::pair("ball", round), std::pair("cavity", around)}) {
    add(std::string("of a solid by lennard_jones, ") + name, example_solid(), particles + partner);
    add(std::string("of patches by lennard_jones, ") + name, example_liquid(),
        particles + partner + tension);
  }
  add("with a ball by smooth_young", example_solid(), adhesive + round);
  add("with a pressed partner", example_solid(),
      adhesive + plane + "direction = [0, 1]\nforce = \"0.2 + 0.1*sin(30*t)\"\nstiffness = 0.5\n");
  cases.push_back({"revolved contact by formulas, friction",
                   ball(example_solid()) +
                       "[[contact]]\nbodies = [\"drop\"]\n"
                       "adhesion = \"0.3 + 0.1*x + 0.05*sin(40*t)\"\noffset = 0.2\n"
                       "range = 0.3\nfriction = 0.4\n" +
                       round + "displacement = [0, \"0.1*t\"]\n",
                   {}});
}

/// Two bodies on the axis that approach each other.
void add_pairs(std::vector<Case>& cases) {
  const std::string other = example_ball(2, "other") +
                            "centre = [0, 2.2]\ninitial_velocity = [\"0.05*x\", \"-0.2\"]\n" +
                            example_solid();
  const auto add = [&](const std::string& name, const std::string& material,
                       const std::string& lines) {
    cases.push_back(
        {"revolved contact of two bodies, " + name,
         ball(material) + other + "[[contact]]\nbodies = [\"drop\", \"other\"]\n" + lines,
         {true, false}});
  };
  const std::string particles = "epsilon = 1\nsigma0 = 0.3\nbeta = 1\nskin = 10\n",
                    gap = "offset = 0.2\nrange = 0.3\nskin = 10\n";
  add("Lennard-Jones", example_solid(), particles);
  add("Lennard-Jones of the reference", example_solid(), particles + "density = \"referential\"\n");
  add("Lennard-Jones of patches", example_liquid(), particles + tension);
  add("law of the gap", example_solid(), "adhesion = 0.3\npoints = 4\n" + gap);
  add("law of the gap, of patches", example_liquid(),
      "adhesion = 0.3\npoints = 4\n" + gap + tension);
  add("ground", example_liquid(), "contact_angle = 80\nup = [0, -1]\n" + gap + tension);
}

void add_loads(std::vector<Case>& cases) {
  const auto add = [&](const std::string& name, const std::string& material,
                       const std::string& lines) {
    cases.push_back({"revolved " + name, ball(material) + lines, {true, false}});
  };
  add("surface_tension", example_liquid(), tension);
  add("surface_tension, weak", example_liquid(),
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\nform = \"weak\"\n");
  cases.push_back({"revolved surface_tension, curvature",
                   ball(example_liquid()) +
                       "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\nform = \"curvature\"\n",
                   {}});
  cases.push_back({"revolved Gauss points",
                   revolved_heading() + example_ball(2, "drop") + "integration = \"gauss\"\n" +
                       about_axis + example_solid(),
                   {true, false},
                   true});
  add("weight of a solid", example_solid(),
      "[[body_force]]\nbody = \"drop\"\nacceleration = [0, \"-1 + 0.1*y*cos(t)\"]\n");
  add("weight of a drop", example_liquid(),
      std::string("[[body_force]]\nbody = \"drop\"\nacceleration = [0, \"-1 + 0.1*cos(t)\"]\n") +
          tension);
  add("traction", example_solid(),
      "[[traction]]\nbody = \"drop\"\nwhere = \"y < -0.5\"\nforce = [\"0.1*x\", 0.2]\n");
  add("pressure", example_solid(),
      "[[traction]]\nbody = \"drop\"\nface = \"rim\"\npressure = 0.2\n");
  cases.push_back(
      {"revolved pressure on a part",
       ball(example_solid()) +
           "[[traction]]\nbody = \"drop\"\nwhere = \"y < -0.5\"\npressure = \"0.1*(1 + x)\"\n",
       {}});
  add("held face", example_solid(),
      "[[held]]\nbody = \"drop\"\nwhere = \"y < -0.8\"\ndisplacement = [0, \"0.01*sin(t)\"]\n");
  for (const char* where : {"where = \"y > 0.5\"\nstiffness = 3\ndamping = 0.2\n",
                            "at = [0.4, 0.3]\nconstant = 3\nresistance = 0.2\n"})
    add(std::string("spring, ") + where, example_solid(),
        std::string("[[spring]]\nbody = \"drop\"\nramp = [0, 0.2]\n") + where +
            "displacement = [\"0.1*x\", 0.1]\n");
  const std::string cavity = "[[cavity]]\nbody = \"drop\"\nsurface = \"outer\"\n";
  add("cavity with a pressure", example_solid(), cavity + "pressure = 0.3\n");
  add("cavity with a content", example_solid(),
      cavity + "volume_target = 0.9\npenalty = 2\nramp = [0, 0.2]\n");
  add("total area", example_solid(),
      "[[area]]\nbody = \"drop\"\nmodulus = 2\narea_target = 1.05\nramp = [0, 0.2]\n");
  add("probe", example_solid(),
      "[[probe]]\nname = \"tip\"\nbody = \"drop\"\nat = [0.05, 0.3]\n"
      "fields = [\"displacement\", \"velocity\", \"pressure\"]\n");
  const std::string sessile = revolved_heading() + sessile_drop(2, about_axis) +
                              "[[wetted]]\nbody = \"drop\"\nface = \"flat\"\n";
  cases.push_back({"revolved wetted face", sessile + "tension = 0.3\n", {}, true});
  cases.push_back({"revolved wetted face that moves, with friction",
                   sessile + "contact_angle = 70\nline_friction = 0.3\n"
                             "displacement = [0, \"0.05*sin(20*t)\"]\n",
                   {},
                   true});
  cases.push_back({"revolved implicit viscosity",
                   revolved_heading("viscosity = \"implicit\"\n") + example_ball(2, "drop") +
                       about_axis + example_liquid() +
                       "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n",
                   {},
                   true});
}

}  // namespace

std::vector<Case> revolved_cases() {
  std::vector<Case> cases;
  add_loads(cases);
  add_contacts(cases);
  add_pairs(cases);
  for (const auto& [name, law] : surface_laws())
    if (name != "anchoring")  // of a nematic, below
      cases.push_back(
          {"revolved surface law " + name,
           ball(example_liquid()) + fmt::format("[[surface]]\nbody = \"drop\"\n[surface.law]\n"
                                                "type = \"{}\"\n{}",
                                                name, law.example),
           {name != "boussinesq_scriven", false}});
  for (const auto& [name, law] : laws()) {
    std::string material = "[body.material]\ntype = \"" + name + "\"\n" + law.example;
    for (const KeyText& key : law.keys())
      if (key.key == "reference_director") material += "reference_director = [0, 1]\n";
    cases.push_back({"revolved material " + name, ball(material), {true, false}, true});
  }
  const std::string nematic =
      "material = { type = \"nematic\", density = 1.25, bulk_modulus = 2.5, viscosity = 0.5, "
      "frank_constant = 0.2, core_length = 0.6, rotational_viscosity = 0.5, flow_alignment = 0.7, "
      "dilatation_coupling = 0.3, initial_director = [\"x*(1 - 0.3*y)\", \"0.8*y + 0.3\"] }\n";
  for (const char* sense : {"apolar", "polar"})
    cases.push_back({std::string("revolved anchoring, ") + sense,
                     ball(nematic) +
                         "[[surface]]\nbody = \"drop\"\n[surface.law]\ntype = "
                         "\"anchoring\"\nstrength = 0.4\nsense = \"" +
                         sense + "\"\n",
                     {true, false},
                     true});
  const std::string
      soft = "material = { type = \"neo_hookean\", density = 1, mu = 3, lambda = 10 }\n",
      stiff = "material = { type = \"neo_hookean\", density = 1, mu = 3, lambda = 3e3 }\n";
  cases.push_back({"revolved nearly incompressible solid", ball(stiff), {true, false}, true});
  for (const auto& [name, solver] : Registry<StepperEntry>::all())
    cases.push_back({"revolved solver " + name,
                     revolved_heading("solver = \"" + name + "\"\n") + example_ball(2, "drop") +
                         about_axis + soft,
                     {true, false},
                     true});
  for (const auto& [shape, lines] :
       {std::pair("rectangle", "size = [1, 2]\nspacing = 0.25\ncentre = [0.5, 0]\n"),
        std::pair("ring", "radius = 1\nthickness = 0.4\naround = 24\nlayers = 3\n"),
        std::pair("half_disk", "radius = 1\ncore = 6\nrings = 3\n"),
        std::pair("ellipse", "semi_axes = [1, 1.4]\ncore = 6\nrings = 3\n"),
        std::pair("red_cell", "diameter = 2\ncore = 6\nrings = 3\n"),
        std::pair("disk_shell", "radius = 2\nheight = 1.6\nthickness = 0.4\nspacing = 0.6\n"),
        std::pair("sphere_shell", "radius = 1\nthickness = 0.4\nspacing = 0.3\n")})
    cases.push_back({std::string("revolved ") + shape,
                     revolved_heading() + "[[body]]\nname = \"body\"\nshape = \"" + shape + "\"\n" +
                         lines + about_axis + soft,
                     {true, false},
                     true});
  return cases;
}

}  // namespace meniscus::test
