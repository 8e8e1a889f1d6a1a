// SPDX-License-Identifier: BSD-3-Clause
// Hard cases of surface laws: skins far stiffer than the body; skins with moduli that are not
// positive; skins as the only elasticity around a liquid; tensions that drive flows for a long time
// or become negative.
#include "study/support/hard_cases.hpp"

#include <fmt/core.h>

namespace meniscus::hard_surfaces_study {
namespace {

using study::HardCases;

const std::string solid =
    "material = { type = \"neo_hookean\", density = 1, mu = 1, lambda = 1.5 }\n";

std::string liquid(Real viscosity) {
  return fmt::format(
      "material = {{ type = \"newtonian\", density = 1, bulk_modulus = 200, viscosity = {} }}\n",
      viscosity);
}

/// A ball of a jittered cloud that is stretched at `rate`.
std::string ball(Real end, Real rate, const std::string& keys, Real safety = 0.9) {
  return fmt::format(
             "dimension = 3\ntime = {{ end = {}, safety = {} }}\n[[body]]\nname = \"ball\"\nshape "
             "= \"ball\"\n"
             "radius = 1\ncore = 5\nlayers = 3\njitter = 0.3\ninitial_velocity = [\"{}*x\", "
             "\"{}*y\", \"{}*z\"]\n",
             end, safety, rate, -rate / 2, -rate / 2) +
         keys;
}

std::string law(const std::string& type, const std::string& numbers) {
  return "[[surface]]\nbody = \"ball\"\nlaw = { type = \"" + type + "\", " + numbers + " }\n";
}

std::string tension() {
  return "[[surface_tension]]\nbody = \"ball\"\ngamma = 1\n";
}

void all(HardCases& cases) {
  const bool full = !cases.study().brief();
  cases.stays_stable(
      "skin a hundred times stiffer than the ball",
      ball(full ? 10 : 1, 0.3, solid + law("neo_hookean_skin", "lambda = 100, mu = 50"), 0.5),
      1e-2);
  cases.stays_stable(
      "skin of negative moduli that the ball holds",
      ball(full ? 40 : 5, 0.05, solid + law("gurtin_murdoch", "lambda = 0.03, mu = -0.035")), 1e-2);
  cases.stops("skin of negative moduli that it does not hold",
              ball(1, 0.05, solid + law("gurtin_murdoch", "lambda = 0.3, mu = -0.35")),
              "is not positive");
  cases.stays_stable(
      "skin is all that holds a liquid",
      ball(full ? 10 : 2, 0.3, liquid(0.5) + law("neo_hookean_skin", "lambda = 1, mu = 0.5")),
      1e-2);
  cases.stays_stable(
      "surface far more viscous than the liquid",
      ball(full ? 2 : 0.2, 0.3,
           liquid(0.05) + tension() + law("boussinesq_scriven", "shear = 2, dilatational = 2")),
      1e-2);
  const std::string driven = "flow driven for sixty times its start-up";
  const auto outcome = cases.stays_stable(
      driven,
      ball(full ? 8 : 1, 0,
           liquid(0.5) + tension() + law("varying_tension", "of = \"place\", gamma = \"0.02*z\"")),
      1e-2);
  cases.require(driven, "error of the momentum", outcome.momentum_error, {0, 1e-10});
  cases.stops("tension that becomes negative",
              ball(4, 0, liquid(0.5) + tension() + law("varying_tension", "gamma = \"-0.5*t\"")),
              "nowhere negative");
}

}  // namespace
}  // namespace meniscus::hard_surfaces_study

namespace meniscus::study {

void hard_surfaces(HardCases& cases) {
  hard_surfaces_study::all(cases);
}

}  // namespace meniscus::study
