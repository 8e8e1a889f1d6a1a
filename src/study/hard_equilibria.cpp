// SPDX-License-Identifier: BSD-3-Clause
// Hard equilibria for Newton's method: an arch that snaps through; a nearly incompressible block
// compressed to half its height; an end rotated by half a turn; a surface that jumps into contact;
// thin drops that relax to a circle.
#include "study/support/hard_cases.hpp"

#include <fmt/core.h>

#include <cmath>

namespace meniscus::hard_equilibria_study {
namespace {

using study::HardCases, study::HardOutcome;

std::string scene(int dimension, Real end, Real step, const std::string& body) {
  return fmt::format(
      "dimension = {}\n[time]\nsolver = \"newton\"\nend = {}\nstep = {}\n[[body]]\nname = "
      "\"body\"\n{}",
      dimension, end, step, body);
}

std::string neo_hookean(Real mu, Real lambda) {
  return fmt::format(
      "material = {{ type = \"neo_hookean\", density = 1, mu = {:.17g}, lambda = {:.17g} }}\n", mu,
      lambda);
}

std::string held(const std::string& name, const std::string& where, const std::string& more = "") {
  return fmt::format("[[held]]\nname = \"{}\"\nbody = \"body\"\n{}\n{}", name, where, more);
}

/// Tables that hold one face and move the opposite one.
std::string gripped(const std::string& base, const std::string& grip, const std::string& motion) {
  return held("base", "face = \"" + base + "\"") + held("grip", "face = \"" + grip + "\"", motion);
}

/// A flat beam is compressed until it is an arch. A grip at a third of its half length from the
/// middle pulls it up and then down to the other side.
void arch(HardCases& cases) {
  const std::string name = "arch snaps through under a grip";
  const HardOutcome outcome = cases.stays_stable(
      name,
      scene(2, 3, 0.05,
            "shape = \"rectangle\"\nsize = [10, 0.5]\ncells = [60, 3]\n" + neo_hookean(1, 1.5)) +
          held("left", "face = \"x_min\"") +
          held("right", "face = \"x_max\"", "displacement = [\"-0.5*min(t, 1)\", 0]\n") +
          held("grip", "where = \"abs(x + 1.583) + 10*abs(y - 0.25) < 0.09\"",
               "components = [\"y\"]\ndisplacement = [0, \"1.1*min(t, 1) - 1.1*max(t - 1, 0)\"]\n"),
      5e-3);
  cases.require(name, "jumps", outcome.measure("jumps"), {1, 1});
  cases.require(name, "force of the grip", outcome.measure("grip.force_y"), {-2e-3, 0});
}

/// A block with nu = 0.495 stuck between plates: the sides bulge and fold over the edges of the
/// plates. The symmetric state becomes unstable, and round-off would decide whether an even block
/// leaves it by a jump. Therefore nodes are jittered. From 0.46 of its height on the block jumps.
void pressed_block(HardCases& cases, bool full) {
  const std::string name = "nearly incompressible block pressed to 0.55 of its height";
  const HardOutcome outcome = cases.stays_stable(
      name,
      scene(2, 1, 0.05,
            fmt::format("shape = \"rectangle\"\nsize = [2, 1]\ncells = {}\njitter = 0.2\n",
                        full ? "[12, 6]" : "[8, 4]") +
                neo_hookean(1, 100)) +
          gripped("y_min", "y_max", "displacement = [0, \"-0.45*t\"]\n"),
      1e-2);
  cases.require(name, "jumps", outcome.measure("jumps"), {0, 0});
  // Expected compression: the pressure of the force, 8 below the plates and less beside them, over
  // the bulk modulus 100.
  cases.require(name, "area / reference area", outcome.measure("body.volume") / 2, {0.89, 0.97});
}

void half_a_turn(HardCases& cases, bool full) {
  const std::string name = "held face turned by 180 degrees";
  const HardOutcome outcome = cases.stays_stable(
      name,
      scene(3, 1, 0.05,
            fmt::format("shape = \"box\"\nsize = [4, 1, 1]\ncells = {}\njitter = 0.2\n",
                        full ? "[12, 4, 4]" : "[8, 3, 3]") +
                neo_hookean(1, 1.5)) +
          gripped("x_min", "x_max", "angle = \"pi*t\"\naxis = [1, 0, 0]\n"),
      1e-2);
  cases.require(name, "jumps", outcome.measure("jumps"), {0, 0});
  // The torque of small strains is mu 0.1406 pi/4 (Saint-Venant). The ends are kept plane, which
  // hinders the warping of sections.
  cases.require(name, "torque / that of small strains",
                outcome.measure("grip.torque_x") / (0.1406 * std::acos(-1.0) / 4), {0.9, 1.2});
}

/// A soft half disk and a plate that approaches it and then moves away farther. The Tabor number (R
/// W^2/(E*^2 g*^3))^(1/3) is 5: the surface jumps into contact and is pulled off late.
void jump_in(HardCases& cases, bool full) {
  const std::string name = "jump into contact at Tabor number 5";
  constexpr Real sigma0 = 0.1, stiffness = 1 / 0.96;
  const Real gap = sigma0 * std::pow(15, -1.0 / 6),
             adhesion = stiffness * std::sqrt(std::pow(5 * gap, 3));
  const HardOutcome outcome = cases.stays_stable(
      name,
      scene(2, 4, 0.05,
            fmt::format("shape = \"half_disk\"\nradius = 1\ncore = {}\nrings = {}\n", full ? 16 : 8,
                        full ? 10 : 5) +
                neo_hookean(1 / 2.4, 1 / 3.6)) +
          held("base", "face = \"flat\"") +
          fmt::format(
              "[[contact]]\nname = \"plate\"\nbodies = [\"body\"]\nepsilon = {:.17g}\nsigma0 = "
              "{}\nbeta = 1\npartner = {{ type = \"half_space\", point = [0, 1.4], normal = "
              "[0, -1], displacement = [0, \"0.4*(abs(t - 1) - 1)\"] }}\n",
              adhesion / (0.968479 * std::pow(sigma0, 4)), sigma0),
      1e-2);
  cases.require(name, "jumps", outcome.measure("jumps"), {2, unbounded});
  cases.require(name, "gap at the end, after pull-off", outcome.measure("plate.gap"), {0.7, 1.3});
}

/// A jittered thin drop with an aspect ratio of four, for viscosities that differ by a factor of
/// 1e5.
void thin_drop(HardCases& cases, Real viscosity) {
  const std::string name = fmt::format("thin drop of viscosity {:g} flows to a circle", viscosity);
  const HardOutcome outcome = cases.stays_stable(
      name,
      scene(2, 1e5, 1e5,
            fmt::format(
                "shape = \"ellipse\"\nsemi_axes = [3, 0.7]\ncore = 6\nrings = 4\njitter = 0.2\n"
                "material = {{ type = \"newtonian\", density = 1, bulk_modulus = 100, "
                "viscosity = {:g} }}\n[[surface_tension]]\nbody = \"body\"\ngamma = 1\n",
                viscosity)),
      1e-2);
  cases.require(name, "circumference / least", outcome.measure("body.isoperimetric"),
                {1 - 1e-4, 1 + 1e-4});
}

}  // namespace
}  // namespace meniscus::hard_equilibria_study

namespace meniscus::study {

void hard_equilibria(HardCases& cases) {
  using namespace hard_equilibria_study;
  const bool full = !cases.study().brief();
  arch(cases);
  pressed_block(cases, full);
  half_a_turn(cases, full);
  jump_in(cases, full);
  for (const Real viscosity : {0.01, 1000.0}) thin_drop(cases, viscosity);
}

}  // namespace meniscus::study
