// SPDX-License-Identifier: BSD-3-Clause
// Hard cases of solids for every law: nearly incompressible, released from large stretches, twists
// and shears, jittered clouds, walls of cells, networks that change their shape, fast impacts.
#include "study/support/hard_cases.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace meniscus::hard_solids_study {
namespace {

using study::HardCases, study::HardOutcome;

/// A law with rho = E = 1 and nu = 0.3 in small strains, so that compression waves have the speed
/// 1.16.
struct Law {
  std::string name, material;
};

constexpr Real mu = 1 / 2.6, lambda = 0.3 / (1.3 * 0.4), bulk = lambda + 2 * mu / 3;

std::string material(const std::string& type, const std::string& numbers) {
  return fmt::format("material = {{ type = \"{}\", density = 1, {} }}\n", type, numbers);
}

std::string elastomer(Real modulus, const std::string& more) {
  return material(
      "liquid_crystal_elastomer",
      fmt::format("mu = {:.17g}, bulk_modulus = {:.17g}, step_length = 2, {}", mu, modulus, more));
}

/// All laws with the bulk modulus `modulus`.
std::vector<Law> laws(Real modulus) {
  const std::string lame = fmt::format("mu = {:.17g}, lambda = {:.17g}", mu, modulus - 2 * mu / 3);
  return {{"neo-Hookean", material("neo_hookean", lame)},
          {"Mooney-Rivlin",
           material("mooney_rivlin", fmt::format("c1 = {:.17g}, c2 = {:.17g}, lambda = {:.17g}",
                                                 0.4 * mu, 0.1 * mu, modulus / 4))},
          {"St.Venant-Kirchhoff", material("st_venant_kirchhoff", lame)},
          {"liquid crystal elastomer", elastomer(modulus, "reference_director = [0, 0, 1]")}};
}

std::string scene(Real end, const std::string& shape, const std::string& keys, int dimension = 3) {
  return fmt::format(
      "dimension = {}\ntime = {{ end = {:.17g} }}\n[[body]]\nname = "
      "\"body\"\n{}\n{}",
      dimension, end, shape, keys);
}

std::string displaced(const std::string& x, const std::string& y, const std::string& z) {
  return fmt::format("initial_displacement = [\"{}\", \"{}\", \"{}\"]\n", x, y, z);
}

const std::string cube = "shape = \"box\"\nsize = [1, 1, 1]\ncells = [5, 5, 5]";
const std::string bar = "shape = \"box\"\nsize = [4, 1, 1]\ncells = [12, 3, 3]";
const std::string swirl =
    "initial_velocity = [\"0.02*sin(pi*x)*cos(pi*y)\", \"-0.02*cos(pi*x)*sin(pi*y)\", \"0\"]\n";

/// Requires that a body that starts at rest or rotates keeps its momenta.
HardOutcome keeps_momenta(HardCases& cases, const std::string& name, const std::string& text,
                          Real bound = 1e-2, const study::HardRun& how = {}) {
  const HardOutcome outcome = cases.stays_stable(name, text, bound, how);
  cases.require(name, "error of the momentum", outcome.momentum_error, {0, 1e-10});
  cases.require(name, "error of the angular momentum", outcome.angular_momentum_error, {0, 1e-10});
  return outcome;
}

/// nu = 0.4999.
void nearly_incompressible(HardCases& cases, bool full) {
  const Real modulus = mu * 2 * 1.4999 / (3 * (1 - 2 * 0.4999));
  for (const Law& law : laws(modulus)) {
    const std::string name = law.name + ", nu = 0.4999";
    const HardOutcome outcome = keeps_momenta(
        cases, name, scene(full ? 2 : 0.3, cube, "jitter = 0.2\n" + law.material + swirl));
    // In liquid crystal elastomers with the director along z, the initial state is not free of
    // stress.
    cases.require(name, "volume / reference volume - 1", outcome.measure("body.volume") - 1,
                  {-1e-3, 1e-3});
  }
}

/// Bars released suddenly from a stretch at constant volume. When the waves from both ends meet,
/// corners move into the bar farther than the particles resolve.
void let_go(HardCases& cases, bool full) {
  const auto all = laws(bulk);
  const std::vector<std::pair<Law, std::vector<Real>>> stretches{
      {all[0], {2, 0.5}}, {all[1], {2, 0.5}}, {all[3], {1.5}}};
  for (const auto& [law, values] : stretches)
    for (const Real s : values)
      keeps_momenta(cases, fmt::format("{} bar let go at a stretch of {}", law.name, s),
                    scene(full ? 6 : 1, bar,
                          displaced(fmt::format("{:.17g}*x", s - 1),
                                    fmt::format("{:.17g}*y", 1 / std::sqrt(s) - 1),
                                    fmt::format("{:.17g}*z", 1 / std::sqrt(s) - 1)) +
                              law.material));
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string turn = fmt::format("{:.17g}*x", std::numbers::pi / 8);
    keeps_momenta(cases, all[k].name + " bar let go at a twist of a quarter turn",
                  scene(full ? 12 : 1, bar,
                        displaced("0", fmt::format("y*cos({0}) - z*sin({0}) - y", turn),
                                  fmt::format("y*sin({0}) + z*cos({0}) - z", turn)) +
                            all[k].material));
  }
  for (std::size_t k = 0; k < 2; ++k)
    keeps_momenta(cases, all[k].name + " cube let go at a shear of 0.5",
                  scene(full ? 6 : 1, cube, displaced("y/2", "0", "0") + all[k].material));
}

void jittered(HardCases& cases, bool full) {
  const std::string solid = "jitter = 0.4\n" + laws(bulk)[0].material;
  const std::string flat_swirl =
      "initial_velocity = [\"0.02*sin(pi*x)*cos(pi*y)\", \"-0.02*cos(pi*x)*sin(pi*y)\"]\n";
  const Real end = full ? 10 : 1;
  keeps_momenta(cases, "ball, jitter 40 %",
                scene(end, "shape = \"ball\"\nradius = 1\ncore = 4\nlayers = 2", solid + swirl));
  keeps_momenta(
      cases, "cylinder, jitter 40 %",
      scene(end, "shape = \"cylinder\"\nradius = 1\nheight = 1\ncore = 3\nrings = 2\nlayers = 3",
            solid + swirl));
  keeps_momenta(
      cases, "disk, jitter 40 %",
      scene(end, "shape = \"disk\"\nradius = 1\ncore = 6\nrings = 3", solid + flat_swirl, 2));
  keeps_momenta(cases, "rectangle, jitter 40 %, Gauss points",
                scene(end, "shape = \"rectangle\"\nsize = [2, 1]\ncells = [12, 6]",
                      "integration = \"gauss\"\n" + solid + flat_swirl, 2));
}

/// Hollow bodies: walls released out of round, cells that are emptied, walls that change their
/// shape.
void walls(HardCases& cases, bool full) {
  const std::string sphere =
      fmt::format("shape = \"sphere_shell\"\nradius = 1\nthickness = {}\nlayers = 4\nspacing = {}",
                  full ? 0.3 : 0.5, full ? 0.4 : 0.8);
  const Real cavity = 4 * std::numbers::pi / 3 * std::pow(full ? 0.7 : 0.5, 3);
  const std::string oval = displaced("0.2*x", "-0.1*y", "-0.1*z");
  const auto all = laws(bulk);
  const Real end = full ? 8 : 0.5;
  for (std::size_t k = 0; k < 2; ++k)
    keeps_momenta(cases, all[k].name + " sphere shell let go out of round",
                  scene(end, sphere, oval + all[k].material));
  keeps_momenta(cases, "liquid crystal elastomer sphere shell let go out of round",
                scene(end, sphere, oval + elastomer(bulk, "director = \"normal\"")));
  keeps_momenta(cases, "cylinder shell let go out of round",
                scene(end,
                      fmt::format("shape = \"cylinder_shell\"\nradius = 1\nheight = 3\nedge_radius "
                                  "= 0.6\nthickness = 0.4\n"
                                  "layers = 4\nspacing = {}",
                                  full ? 0.5 : 0.9),
                      displaced("0.1*x", "-0.1*y", "0") + all[0].material));
  const Real slowly = full ? 8 : 6;
  const HardOutcome emptied = cases.stays_stable(
      "cell emptied by a fifth",
      scene(slowly, sphere, all[1].material) +
          fmt::format(
              "[[cavity]]\nbody = \"body\"\nvolume_target = 0.8\npenalty = 2\nramp = [0, {}]\n",
              0.8 * slowly),
      1e-2);
  cases.require("cell emptied by a fifth", "volume of the cavity / target",
                emptied.measure("body.cavity_volume") / (0.8 * cavity), {0.97, 1.1});
  cases.stays_stable(
      "cell with an active wall",
      scene(end, sphere,
            elastomer(bulk, fmt::format("activity = 0.05, activity_ramp = [0, {}]", 0.8 * end))),
      1e-2);
}

/// Networks of liquid crystal elastomers that are heated or whose director turns.
void nematic(HardCases& cases, bool full) {
  const Real end = full ? 12 : 1;
  cases.stays_stable(
      "liquid crystal elastomer bar heated",
      scene(end, bar,
            elastomer(bulk, fmt::format("director = \"convected\", reference_director = [1, 0, 0], "
                                        "step_length_end = 1, step_length_ramp = [0, {}]",
                                        0.5 * end))),
      1e-2);
  keeps_momenta(cases, "liquid crystal elastomer whose director turns by a quarter",
                scene(end, cube,
                      swirl + elastomer(bulk,
                                        "director = \"convected\", reference_director = "
                                        "[\"cos(pi*y/2)\", \"sin(pi*y/2)\", 0]")));
}

void fast(HardCases& cases, bool full) {
  const auto all = laws(bulk);
  keeps_momenta(
      cases, "Mooney-Rivlin cube that meets itself at 0.3 c",
      scene(full ? 3 : 1, cube,
            "initial_velocity = [\"-0.348*tanh(20*x)\", \"0\", \"0\"]\n" + all[1].material),
      1e-2);
  keeps_momenta(cases, "disk spun to 0.3 c at its rim",
                scene(full ? 20 : 2, "shape = \"disk\"\nradius = 1\ncore = 6\nrings = 3",
                      "initial_velocity = [\"-0.348*y\", \"0.348*x\"]\n" + all[0].material, 2));
  const std::string name = "ball thrown at a wall at 0.2 c";
  const HardOutcome thrown = cases.stays_stable(
      name,
      scene(full ? 6 : 1,
            "shape = \"ball\"\nradius = 1\ncore = 4\nlayers = 2\ncentre = [0, 0, 1.35]",
            "initial_velocity = [0, 0, -0.232]\n" + all[0].material) +
          "[[contact]]\nname = \"wall\"\nbodies = [\"body\"]\nepsilon = 0.05\nsigma0 = 0.3\nbeta = "
          "1\n"
          "partner = { type = \"half_space\", point = [0, 0, 0], normal = [0, 0, 1] }\n",
      1e-2, {.watched = {"wall.gap"}});
  const auto gap = thrown.least.find("wall.gap");
  cases.require(name, "least gap / sigma0",
                gap == thrown.least.end() ? std::nan("") : gap->second / 0.3, {0.2, 1});
}

/// Bars rotated by half a turn at one end, and at both ends; then only the rotation may remain.
void turned(HardCases& cases, bool full) {
  const Real end = full ? 24 : 8;
  const std::string by_half_a_turn = fmt::format(
      "axis = [1, 0, 0]\nangle = {:.17g}\nramp = [0, {}]\n", std::numbers::pi, 0.75 * end);
  const std::string turned_face = "[[held]]\nbody = \"body\"\nface = \"x_max\"\nname = \"grip\"\n";
  const std::string other_face = "[[held]]\nbody = \"body\"\nface = \"x_min\"\n";
  for (const Law& law : {laws(bulk)[0], laws(bulk)[1]}) {
    const std::string twisted = law.name + " bar held at one end, the other turned by 180 degrees";
    const HardOutcome outcome =
        cases.stays_stable(twisted,
                           scene(end, bar, "jitter = 0.2\n" + law.material) + turned_face +
                               by_half_a_turn + other_face,
                           1e-2);
    cases.require(twisted, "work of the grip", outcome.measure("grip.work"), {0.05, 1});
  }
  const std::string both = "bar turned by 180 degrees by both ends";
  cases.stays_stable(both,
                     scene(end, bar, "jitter = 0.2\n" + laws(bulk)[0].material) + turned_face +
                         by_half_a_turn + other_face + by_half_a_turn,
                     1e-2);
}

}  // namespace
}  // namespace meniscus::hard_solids_study

void meniscus::study::hard_solids(HardCases& cases) {
  const bool full = !cases.study().brief();
  using namespace hard_solids_study;
  nearly_incompressible(cases, full);
  let_go(cases, full);
  jittered(cases, full);
  walls(cases, full);
  nematic(cases, full);
  fast(cases, full);
  turned(cases, full);
}
