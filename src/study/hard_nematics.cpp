// SPDX-License-Identifier: BSD-3-Clause
// Hard cases of nematics: defect cores below the particle spacing, directors that tumble, directors
// that relax far faster than the liquid moves, strong anchoring at the surface, and defects that
// leave.
#include "study/support/hard_cases.hpp"

#include <fmt/core.h>

namespace meniscus::hard_nematics_study {
namespace {

using study::HardCases;

struct Nematic {
  Real end = 1, K = 0.2, core = 0.3, gamma_1 = 0.5, lambda = 1;
  std::string director =
      "\"x/sqrt(x^2 + y^2 + z^2 + 0.1)\", \"y/sqrt(x^2 + y^2 + z^2 + 0.1)\", "
      "\"z/sqrt(x^2 + y^2 + z^2 + 0.1)\"";
  std::string velocity = "0, 0, 0", anchoring = "";

  /// A ball of a jittered cloud with spacing about 0.2.
  std::string scene() const {
    return fmt::format(
               "dimension = 3\ntime = {{ end = {} }}\n[[body]]\nname = \"ball\"\nshape = \"ball\"\n"
               "radius = 1\ncore = 5\nlayers = 2\njitter = 0.3\ninitial_velocity = [{}]\n"
               "[body.material]\ntype = \"nematic\"\ndensity = 1\nbulk_modulus = 100\nviscosity = "
               "0.3\nfrank_constant = {}\ncore_length = {}\nrotational_viscosity = "
               "{}\nflow_alignment = {}\ninitial_director = [{}]\n[[surface_tension]]\nbody = "
               "\"ball\"\ngamma = 1\n",
               end, velocity, K, core, gamma_1, lambda, director) +
           (anchoring.empty() ? ""
                              : "[[surface]]\nbody = \"ball\"\nlaw = { type = \"anchoring\", " +
                                    anchoring + " }\n");
  }
};

void all(HardCases& cases) {
  const Real share = cases.study().brief() ? 0.2 : 1;
  const auto run = [&](const std::string& name, const Nematic& drop) {
    const auto outcome = cases.stays_stable(name, drop.scene(), 1e-2);
    cases.require(name, "error of the angular momentum", outcome.angular_momentum_error,
                  {0, 1e-10});
    return outcome;
  };
  const std::string shear = "\"1.5*y\", 0, 0";
  run("hedgehog whose core the particles do not resolve",
      {.end = 2 * share, .core = 0.04, .anchoring = "strength = 2, sense = \"polar\""});
  run("director that tumbles in a drop that is sheared",
      {.end = 2 * share, .lambda = 0.4, .director = "0.6, 0.8, 0", .velocity = shear});
  run("discs in a drop that is sheared",
      {.end = 2 * share, .lambda = -2.5, .director = "0.6, 0.8, 0", .velocity = shear});
  run("director that relaxes a thousand times faster than the drop moves",
      {.end = 1 * share, .gamma_1 = 1e-3, .velocity = shear});
  run("director that the surface does not let go",
      {.end = 1 * share, .velocity = shear, .anchoring = "strength = 40, sense = \"apolar\""});
  const std::string leaves = "defect that leaves through the surface";
  const auto outcome =
      run(leaves, {.end = 4 * share,
                   .gamma_1 = 0.1,
                   .director = "\"(x - 0.6)/sqrt((x - 0.6)^2 + y^2 + z^2 + 0.1)\", "
                               "\"y/sqrt((x - 0.6)^2 + y^2 + z^2 + 0.1)\", "
                               "\"z/sqrt((x - 0.6)^2 + y^2 + z^2 + 0.1)\""});
  if (share == 1) {
    cases.require(leaves, "order at the end", outcome.measure("ball.director_order"), {0.99, 1.01});
    cases.require(leaves, "energy at the end", outcome.measure("ball.director_energy"), {0, 0.02});
  }
}

}  // namespace
}  // namespace meniscus::hard_nematics_study

namespace meniscus::study {

void hard_nematics(HardCases& cases) {
  hard_nematics_study::all(cases);
}

}  // namespace meniscus::study
