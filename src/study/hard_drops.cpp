// SPDX-License-Identifier: BSD-3-Clause
// Hard cases of drops: far from round, hardly viscous, with edges, spun, held to each other, and
// left alone for long.
#include <fmt/core.h>

#include <cmath>

#include "support/hard_cases.hpp"

namespace meniscus::study {
namespace {

/// A drop with rho = gamma = 1.
std::string drop(const std::string& shape, Real Oh, Real end, const std::string& keys = "") {
  return fmt::format(
      "dimension = 3\ntime = {{ end = {} }}\n[[body]]\nname = "
      "\"body\"\n{}\n{}material = {{ type = "
      "\"newtonian\", density = 1, bulk_modulus = 200, viscosity = {} "
      "}}\n[[surface_tension]]\nbody "
      "= \"body\"\ngamma = 1\n",
      end, shape, keys, Oh);
}

std::string ellipsoid(const std::string& axes, int core) {
  return fmt::format("shape = \"ellipsoid\"\nsemi_axes = {}\ncore = {}\nlayers = {}", axes, core,
                     core / 2);
}

/// Ends as a sphere whose facets have kept their sizes.
void is_round(HardCases& cases, const std::string& name, const HardOutcome& outcome,
              Real tolerance) {
  cases.study().require(name + ": isoperimetric - 1", outcome.measure("body.isoperimetric") - 1,
                        {-1e-6, tolerance});
}

void left_alone(HardCases& cases, bool full) {
  const int core = full ? 6 : 4;
  const Real end = full ? 60 : 6;
  for (const Real Oh : {0.01, 0.93}) {
    const std::string name = fmt::format("drop 1 : 1.2 : 1 left alone, Oh = {}", Oh);
    const auto outcome =
        cases.stays_stable(name, drop(ellipsoid("[1, 1.2, 1]", core), Oh, end), 1e-2);
    if (Oh > 0.1) is_round(cases, name, outcome, 1e-4);
    cases.study().require(name + ": error of the angular momentum", outcome.angular_momentum_error,
                          {0, 1e-10});
  }
}

void with_edges(HardCases& cases, bool full) {
  const std::string box = full ? "cells = [7, 7, 7]" : "cells = [4, 4, 4]";
  const std::string disk =
      full ? "core = 6\nrings = 3\nlayers = 8" : "core = 3\nrings = 2\nlayers = 4";
  for (const auto& [name, shape] :
       {std::pair<std::string, std::string>{"drop from a box",
                                            "shape = \"box\"\nsize = [1.6, 1.6, 1.6]\n" + box},
        {"drop from a cylinder", "shape = \"cylinder\"\nradius = 0.87\nheight = 1.75\n" + disk}}) {
    const auto outcome = cases.stays_stable(name, drop(shape, 0.93, full ? 20 : 5), 1e-2);
    is_round(cases, name, outcome, full ? 1e-2 : 3e-2);
  }
}

void spun(HardCases& cases, bool full) {
  const std::string name = "spun drop";
  const auto outcome =
      cases.stays_stable(name,
                         drop(ellipsoid("[1, 1, 1]", 4), 0.93, full ? 40 : 5,
                              "initial_velocity = [\"-0.3*y\", \"0.3*x\", \"0\"]\n"),
                         1e-2);
  cases.study().require(name + ": error of the angular momentum", outcome.angular_momentum_error,
                        {0, 1e-10});
}

/// Two drops that van der Waals forces hold to each other: they come closer, flatten where they
/// face each other, and rest.
void held_together(HardCases& cases, bool full) {
  std::string text = fmt::format("dimension = 3\ntime = {{ end = {} }}\n", full ? 20 : 5);
  for (const auto& [name, x] : {std::pair<std::string, Real>{"left", -1.12}, {"right", 1.12}})
    text += fmt::format(
        "[[body]]\nname = \"{0}\"\nshape = \"ball\"\nradius = 1\ncore = 4\nlayers = 2\ncentre = "
        "[{1}, 0, 0]\nmaterial = {{ type = \"newtonian\", density = 1, bulk_modulus = 200, "
        "viscosity = 0.93 }}\n[[surface_tension]]\nbody = \"{0}\"\ngamma = 1\n",
        name, x);
  text +=
      "[[contact]]\nname = \"contact\"\nbodies = [\"left\", \"right\"]\nepsilon = 0.5\nsigma0 = "
      "0.3\nbeta = 1\npoints = 3\n";
  const std::string name = "two drops held to each other";
  const auto outcome = cases.stays_stable(name, text, 1e-2);
  for (const std::string side : {"left", "right"})
    cases.study().require(name + ": capillary number of the " + side + " one",
                          outcome.measure(side + ".ca"), {0, 1e-4});
  cases.study().require(name + ": gap / sigma0", outcome.measure("contact.gap") / 0.3, {0.5, 0.75});
}

}  // namespace

void hard_drops(HardCases& cases) {
  const bool full = !cases.study().brief();
  // Its particles stay where the long reference has them: later the surface of the drop is no
  // longer resolved.
  const std::string long_drop = "drop 1 : 4 : 1";
  const HardOutcome relaxed = cases.stays_stable(
      long_drop,
      drop(ellipsoid("[0.63, 2.52, 0.63]", 6), 0.93, full ? 0.75 : 0.3, "support_factor = 2.3\n"),
      1e-2);
  cases.study().require(long_drop + ": area / area of the sphere",
                        relaxed.measure("body.area") / 12.566, {1, 1.28});
  cases.stays_stable("drop at Oh = 0.01",
                     drop(ellipsoid("[1, 1.1, 1]", full ? 6 : 4), 0.01, full ? 20 : 4), 1e-2);
  left_alone(cases, full);
  with_edges(cases, full);
  spun(cases, full);
  held_together(cases, full);
}

}  // namespace meniscus::study
