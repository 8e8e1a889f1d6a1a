// SPDX-License-Identifier: BSD-3-Clause
// Hard cases of bodies of revolution (axisymmetry note): what happens at the axis.
#include "study/support/hard_cases.hpp"

#include <fmt/core.h>

namespace meniscus::study {
namespace {

std::string body_of(const std::string& shape, const std::string& material,
                    const std::string& time) {
  return "dimension = \"axisymmetric\"\ntime = { " + time + " }\n[[body]]\nname = \"body\"\n" +
         shape + "material = { " + material + " }\n";
}
std::string drop_of(const std::string& shape, Real Oh, Real end) {
  return body_of(shape,
                 fmt::format("type = \"newtonian\", density = 1, bulk_modulus = 200, "
                             "viscosity = {}",
                             Oh),
                 fmt::format("end = {}", end)) +
         "[[surface_tension]]\nbody = \"body\"\ngamma = 1\n";
}
const std::string rubber = "type = \"neo_hookean\", density = 1, mu = 10, lambda = 100";

void drops(HardCases& cases, bool full) {
  cases.stops(
      "liquid torus that closes over its axis",
      drop_of("shape = \"disk\"\nradius = 1\ncentre = [2, 0]\ncore = 6\nrings = 3\n", 0.5, 40),
      "beyond the axis x = 0");
  const std::string jet = "jet of 1 : 5 that becomes a ball";
  const HardOutcome outcome = cases.stays_stable(
      jet,
      drop_of("shape = \"rectangle\"\nsize = [1, 10]\ncentre = [0.5, 0]\nspacing = 0.2\n", 0.1,
              full ? 60 : 20),
      3e-2);
  if (full)
    cases.require(jet, "isoperimetric - 1", outcome.measure("body.isoperimetric") - 1,
                  {-1e-5, 1e-2});
  if (full)
    cases.stops("column that pinches off",
                drop_of("shape = \"rectangle\"\nsize = [1, 40]\ncentre = [0.5, 0]\n"
                        "spacing = 0.25\nmap = [\"x*(1 - 0.1*cos(2*pi*y/10))\", \"y\"]\n",
                        0.05, 60),
                "the stable time step has collapsed");
}

void solids(HardCases& cases, bool full) {
  const std::string dent = "sphere of rubber whose pole is turned in";
  const HardOutcome outcome = cases.stays_stable(
      dent,
      body_of("shape = \"sphere_shell\"\nradius = 1\nthickness = 0.06\nlayers = 3\n"
              "spacing = 0.06\n",
              rubber, "end = 400, solver = \"relax\"") +
          "[[cavity]]\nbody = \"body\"\nvolume_target = 0.7\npenalty = 1e3\nramp = [0, 100]\n"
          "[[spring]]\nname = \"pull\"\nbody = \"body\"\nat = [0, 1]\nconstant = 0.1\n"
          "displacement = [0, -1]\nramp = [0, 50]\n"
          "[[spring]]\nname = \"seat\"\nbody = \"body\"\nat = [0, -1]\nconstant = 1\n",
      1e-3);
  cases.require(dent, "outer thickness at the pole", outcome.measure("body.pole_thickness"),
                {0.9, 1.1});
  cases.stays_stable("ball that hits a ball with its pole",
                     body_of(fmt::format("shape = \"disk\"\nradius = 1\ncore = {0}\nrings = {1}\n"
                                         "initial_velocity = [0, -0.3]\n",
                                         full ? 12 : 8, full ? 6 : 4),
                             rubber, "end = 8") +
                         "[[contact]]\nbodies = [\"body\"]\nadhesion = 0.2\noffset = 0.3\n"
                         "range = 0.3\n[contact.partner]\ntype = \"ball\"\ncentre = [0, -2.6]\n"
                         "radius = 1\n",
                     1e-2);
}

}  // namespace

void hard_revolved(HardCases& cases) {
  const bool full = !cases.study().brief();
  drops(cases, full);
  solids(cases, full);
}

}  // namespace meniscus::study
