// SPDX-License-Identifier: BSD-3-Clause
// Nearly incompressible solids of two to four cells across, where others lock (locking note): the
// error of scenes against exact solutions, or against cantilevers of many cells.
#include "study/study.hpp"
#include "study/support/scene_run.hpp"

#include <fmt/core.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace meniscus::coarse_solids_study {
namespace {

/// A scene, the measure that is compared, and its exact value.
struct Case {
  std::string name;  ///< with the ratio of bulk to shear modulus
  int dimension;
  std::string text, measure;
  Real exact;
  Range allowed;  ///< of measure / exact with the default of `volumetric`
};

template <int D>
Measurement run_case(const Case& c, const std::string& method, int level) {
  return study::measure_scene<D>(
      c.text, method, level, [&](const Scene<D>& scene, const Motion& motion, Measurement& result) {
        for (const MeasureSource& m : scene.measures)
          if (m.name == c.measure) {
            const Real value = m.compute(motion);
            result.values = {{"value / exact", value / c.exact}};
            result.errors = {{"error", std::abs(value / c.exact - 1)}};
          }
      });
}

/// Lame's first modulus over the shear modulus for a ratio of bulk to shear modulus.
Real lambda_of(Real ratio) {
  return ratio - 2.0 / 3.0;
}
Real poisson_of(Real ratio) {
  return (3 * ratio - 2) / (6 * ratio + 2);
}

std::string neo_hookean(Real ratio) {
  return fmt::format(
      "material = {{ type = \"neo_hookean\", density = 1, mu = 1, lambda = {:.17g} }}\n",
      lambda_of(ratio));
}

/// A cantilever of length 10, height 1 (and width 1) with a small load at its end. `converged` is
/// its deflection over the deflection of Timoshenko's beam with the shear factor 5/6, extrapolated
/// from 8, 12 and 16 cells across (3D: 3, 4 and 5).
Case cantilever(int D, int across, Real ratio, Real converged, const std::string& more) {
  const Real nu = poisson_of(ratio), E = 2 * (1 + nu), load = 1e-5;
  const Real of_width = D == 2 ? E / (1 - nu * nu) : E;
  const Real beam = load * (1000 / (3 * of_width / 12) + 10 / (5.0 / 6));
  const std::string size = D == 2 ? "[10, 1]" : "[10, 1, 1]",
                    force = D == 2 ? "[0, 1e-5]" : "[0, 1e-5, 0]",
                    cells = D == 2 ? fmt::format("[{}, {}]", 10 * across, across)
                                   : fmt::format("[{}, {}, {}]", 10 * across, across, across);
  // Two, three and four cells across have at least these shares of the converged deflection.
  const Real least = across == 2 ? 0.975 : across == 3 ? 0.985 : 0.995;
  return {
      fmt::format("{}D cantilever, K/mu = {:g}", D, ratio),
      D,
      fmt::format("dimension = {}\ntime = {{ solver = \"newton\", end = 1, step = 1 }}\n[[body]]\n"
                  "name = \"beam\"\nshape = \"{}\"\nsize = {}\ncells = {}\n{}{}"
                  "[[held]]\nbody = \"beam\"\nface = \"x_min\"\n[[traction]]\nname = \"end\"\n"
                  "body = \"beam\"\nface = \"x_max\"\nforce = {}\n",
                  D, D == 2 ? "rectangle" : "box", size, cells, more, neo_hookean(ratio), force),
      "end.displacement_y",
      converged * beam,
      {least, 1.02}};
}

/// A cantilever of length 10 and height 1 bent by 46 % of its length, at Poisson's ratio 0.499:
/// deflection, from the elastica (inextensible, no shear) with P L^2/(E I) = 1.8024.
Case bend(int across, const std::string& more) {
  return {
      "2D large bend, K/mu = 500",
      2,
      fmt::format("dimension = 2\ntime = {{ solver = \"newton\", end = 4, step = 1 }}\n[[body]]\n"
                  "name = \"beam\"\nshape = \"rectangle\"\nsize = [10, 1]\ncells = [{}, {}]\n{}"
                  "material = {{ type = \"neo_hookean\", density = 1, youngs_modulus = 1000, "
                  "poissons_ratio = 0.499 }}\n[[held]]\nbody = \"beam\"\nface = \"x_min\"\n"
                  "[[traction]]\nname = \"end\"\nbody = \"beam\"\nface = \"x_max\"\nforce = "
                  "[0, \"2*min(1, t/4)\"]\n",
                  10 * across, across, more),
      "end.displacement_y",
      4.63647,
      {0.985, 1.01}};
}

/// Cook's membrane, a tapered panel that is sheared at its end by a seventh of its length. `tip` is
/// the displacement of its upper corner, extrapolated from 32 and 64 cells in each direction.
Case cook(int across, Real lambda_over_mu, Real tip, const std::string& more) {
  const int cells = 4 * across;
  const Real least = across == 2 ? 0.993 : across == 3 ? 0.996 : 0.998;
  return {
      fmt::format("Cook's membrane, lambda/mu = {:g}", lambda_over_mu),
      2,
      fmt::format("dimension = 2\ntime = {{ solver = \"newton\", end = 4, step = 1 }}\n[[body]]\n"
                  "name = \"panel\"\nshape = \"rectangle\"\ncorner = [0, 0]\nsize = [48, 1]\n"
                  "cells = [{0}, {0}]\nmap = [\"x\", \"44/48*x + y*(44 - 28/48*x)\"]\n{1}material "
                  "= {{ type = \"neo_hookean\", density = 1, mu = 80.194, lambda = {2} }}\n"
                  "[[held]]\nbody = \"panel\"\nface = \"x_min\"\n[[traction]]\nbody = \"panel\"\n"
                  "face = \"x_max\"\nforce = [0, \"6.25*min(1, t/4)\"]\n[[probe]]\nname = \"tip\"\n"
                  "body = \"panel\"\nat = [48, 60]\n",
                  cells, more, 80.194 * lambda_over_mu),
      "tip.displacement_y",
      tip,
      {least, 1.002}};
}

/// A plane ring with a small pressure inside (Lame): outer displacement, exact by formula.
Case ring(int layers, Real ratio, const std::string& more) {
  constexpr Real a = 0.5, b = 1, p = 1e-4;
  const Real nu = poisson_of(ratio), E = 2 * (1 + nu);
  const Real u = (1 + nu) / E * p * a * a / (b * b - a * a) * ((1 - 2 * nu) * b + b);
  return {fmt::format("ring, K/mu = {:g}", ratio),
          2,
          fmt::format(
              "dimension = 2\ntime = {{ solver = \"relax\", end = 400, force_tolerance = 1e-6, "
              "shape_tolerance = 1e-7 }}\n[[body]]\nname = \"ring\"\nshape = \"ring\"\nradius = "
              "1\nthickness = 0.5\naround = {}\nlayers = {}\n{}{}[[traction]]\nname = "
              "\"inside\"\nbody = \"ring\"\nface = \"inner\"\npressure = {}\nramp = [0, 1]\n"
              "[[probe]]\nname = \"outside\"\nbody = \"ring\"\nat = [1, 0]\n",
              8 * layers, layers, more, neo_hookean(ratio), p),
          "outside.displacement_x",
          u,
          {0.995, 1.005}};
}

/// A hollow sphere blown up to four times the volume of its cavity: pressure, from the equilibrium
/// of the radial stress, an ordinary differential equation (at 3.996 V0, which the penalty leaves).
Case balloon(int layers, const std::string& more) {
  constexpr Real ratio = 425, pressure = 0.43562;
  return {fmt::format("hollow sphere to 4 V, K/mu = {:g}", ratio),
          3,
          fmt::format(
              "dimension = 3\ntime = {{ solver = \"relax\", end = 100, force_tolerance = 1e-4, "
              "shape_tolerance = 1e-4 }}\n[[body]]\nname = \"s\"\nshape = \"sphere_shell\"\nradius "
              "= 1\nthickness = 0.3\nlayers = {}\nspacing = {:.6g}\n{}{}[[cavity]]\nbody = \"s\"\n"
              "volume_target = 4\npenalty = {}\nramp = [0, 10]\n",
              layers, 0.75 / layers, more, neo_hookean(ratio), ratio / 4),
          "s.cavity_pressure",
          pressure,
          {0.995, 1.005}};
}

/// A cylinder twisted by 1.5 radians per unit length between rigid plates (Rivlin 1948): axial
/// force of an incompressible neo-Hookean rod, - pi mu R^4 tau^2/4.
Case twist(int core, const std::string& more) {
  constexpr Real ratio = 500, angle = 3, tau = angle / 2;
  return {
      fmt::format("axial force of a twisted rod, K/mu = {:g}", ratio),
      3,
      fmt::format("dimension = 3\ntime = {{ solver = \"relax\", end = 400, force_tolerance = 1e-4, "
                  "shape_tolerance = 1e-4 }}\n[[body]]\nname = \"rod\"\nshape = \"cylinder\"\n"
                  "radius = 0.5\nheight = 2\ncore = {}\nrings = {}\nlayers = {}\n{}{}[[held]]\n"
                  "body = \"rod\"\nface = \"z_min\"\n[[held]]\nname = \"grip\"\nbody = \"rod\"\n"
                  "face = \"z_max\"\nangle = {}\nramp = [0, 10]\n",
                  core, core, 4 * core, more, neo_hookean(ratio), angle),
      "grip.force_z",
      -std::numbers::pi * tau * tau / 64,
      {0.995, 1.005}};
}

/// Deflections of cantilevers of many cells over Timoshenko's, by K/mu; see cantilever().
struct Converged {
  Real ratio, in_2D, in_3D;
};
constexpr Converged converged[] = {
    {1, 0.9996, 0.9988}, {50, 0.9853, 0.9795}, {5000, 0.9843, 0.9785}, {1e5, 0.9843, 0.9785}};

/// Tips of Cook's membrane, by lambda/mu.
constexpr std::pair<Real, Real> cook_tips[] = {
    {1.5, 8.6924}, {50, 7.0285}, {500, 6.9408}, {5000, 6.9318}, {5e4, 6.9309}};

void measure(StudyRun& study, const Case& c, const std::string& form, int level) {
  const std::string method = c.name + ", " + form;
  const Measurement result =
      c.dimension == 2 ? run_case<2>(c, method, level) : run_case<3>(c, method, level);
  study.record(result);
  if (form != "full")
    study.require(fmt::format("{}, {} across: value / exact", c.name, level),
                  result.values.front().second, c.allowed);
}

void run(StudyRun& study) {
  study.finish_settings();
  const std::map<std::string, std::string> forms{{"full", "volumetric = \"full\"\n"},
                                                 {"default", ""},
                                                 {"default, jittered", "jitter = 0.2\n"}};
  for (const auto& [form, keys] : forms)
    for (const int across : study.levels()) {
      for (const Converged& c : converged) {
        if (study.brief() && c.ratio != 5000) continue;
        measure(study, cantilever(2, across, c.ratio, c.in_2D, keys), form, across);
        if (!study.brief() && across < 4)
          measure(study, cantilever(3, across, c.ratio, c.in_3D, keys), form, across);
      }
      if (form == "default, jittered") continue;  // layers of walls stay in order
      for (const Real ratio : {5.0, 5000.0})
        measure(study, ring(across + 1, ratio, keys), form, across);
      // Newton's method takes many iterations for bodies that lock.
      for (const auto& [ratio, tip] : cook_tips)
        if (form == "default" ? !study.brief() || ratio == 5000 : ratio < 100 && !study.brief())
          measure(study, cook(across, ratio, tip, keys), form, across);
      if (form == "default") measure(study, bend(across, keys), form, across);
      if (study.brief() || across > 3) continue;
      measure(study, balloon(across + 1, keys), form, across);
      measure(study, twist(across, keys), form, across);
    }
}

const bool registered = register_entry(
    StudyEntry{"coarse_solids",
               "nearly incompressible solids of few cells: deflections, pressures and forces, with "
               "volume changes of stress points and shared by cells",
               "cells across a beam; walls have one more",
               {2, 3, 4},
               {2},
               run});

}  // namespace
}  // namespace meniscus::coarse_solids_study
