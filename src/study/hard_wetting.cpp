// SPDX-License-Identifier: BSD-3-Clause
// Hard cases of drops on walls: contact angles near 0 and 180 degrees; a heavy drop with little
// adhesion; complete wetting; coarse ranges and supports at the contact line; impact and lift-off;
// two drops that meet; a tip pulled out of a film; ground too soft for its adhesion.
#include "study/support/hard_cases.hpp"

#include <fmt/core.h>

namespace meniscus::study {
namespace {

std::string drop(const std::string& name, Real x, const std::string& keys = "") {
  return fmt::format(
      "[[body]]\nname = \"{0}\"\nshape = \"ball\"\nradius = 1\ncore = 4\nlayers = 2\ncentre = "
      "[{1}, 0, 0]\n{2}material = {{ type = \"newtonian\", density = 1, bulk_modulus = 151, "
      "viscosity = 1 }}\n[[surface_tension]]\nbody = \"{0}\"\ngamma = 1\n",
      name, x, keys);
}

std::string wall(const std::string& name, const std::string& keys, Real height = -1.08) {
  return fmt::format(
      "[[contact]]\nname = \"{0}-wall\"\nbodies = [\"{0}\"]\n{1}points = "
      "3\n[contact.partner]\ntype "
      "= \"half_space\"\npoint = [0, 0, {2}]\nnormal = [0, 0, 1]\n",
      name, keys, height);
}

std::string heading(Real end) {
  return fmt::format("dimension = 3\n[time]\nend = {}\nviscosity = \"implicit\"\n", end);
}

const std::string lengths = "offset = 0.05\nrange = 0.15\n";

void angles(HardCases& cases, bool full) {
  const Real end = full ? 6 : 1;
  for (const int angle : {30, 150}) {
    const std::string name = fmt::format("drop on a wall, {} degrees", angle);
    const auto outcome =
        cases.stays_stable(name,
                           heading(end) + drop("drop", 0) +
                               wall("drop", fmt::format("contact_angle = {}\n", angle) + lengths),
                           1e-2);
    if (full)
      cases.require(name, "angle of the cap", outcome.measure("drop-wall.contact_angle_vh"),
                    angle == 150 ? Range{143, 153} : Range{28, 45});
  }
  const std::string heavy = "heavy drop on a wall, 175 degrees";
  const auto outcome =
      cases.stays_stable(heavy,
                         heading(end) + drop("drop", 0) +
                             "[[body_force]]\nbody = \"drop\"\nacceleration = [0, 0, -0.5]\n" +
                             wall("drop", "contact_angle = 175\n" + lengths),
                         1e-2);
  if (full)
    cases.require(heavy, "gap / offset", outcome.measure("drop-wall.gap") / 0.05, {0.7, 1.1});
  const std::string complete = "drop on a wall, adhesion of water on copper";
  cases.says(complete,
             cases.stays_stable(
                 complete,
                 heading(full ? 4 : 1) + drop("drop", 0) +
                     wall("drop", "interaction = \"smooth_young\"\nadhesion = 2.75\n" + lengths),
                 1e-2),
             "complete wetting");
}

void lengths_too_short(HardCases& cases, bool full) {
  const Real end = full ? 6 : 1;
  const std::string narrow = "drop on a wall, range 0.28 of a facet";
  cases.says(
      narrow,
      cases.stays_stable(narrow,
                         heading(end) + drop("drop", 0) +
                             wall("drop", "contact_angle = 90\noffset = 0.05\nrange = 0.1\n"),
                         1e-2),
      "contact line moves from facet to facet");
  const std::string coarse = "drop on a Lennard-Jones wall, R / sigma0 = 5";
  cases.stays_stable(coarse,
                     heading(end) + drop("drop", 0) +
                         wall("drop",
                              "interaction = \"scaled_lennard_jones\"\ncontact_angle = 90\nsigma0 "
                              "= 0.2\n",
                              -1.15),
                     1e-2);
}

void motions(HardCases& cases, bool full) {
  const Real end = full ? 6 : 1;
  const std::string impact = "drop of water meets a wall at 50 m/s";
  cases.stays_stable(impact,
                     heading(end) + drop("drop", 0, "initial_velocity = [0, 0, -0.414]\n") +
                         wall("drop", "contact_angle = 90\n" + lengths, -1.3),
                     1e-2);
  const std::string lift = "drop is let go by a wall that loses its adhesion";
  const auto outcome = cases.stays_stable(
      lift,
      heading(full ? 6 : 2) + drop("drop", 0) +
          wall("drop", "interaction = \"smooth_young\"\nadhesion = \"exp(-2*t)\"\n" + lengths),
      1e-2);
  cases.require(lift, "wetted area / (pi R^2)", outcome.measure("drop-wall.wetted_area") / 3.14159,
                {0, full ? 0.1 : 0.6});
  const std::string two = "two drops meet on a wall";
  cases.stays_stable(
      two,
      heading(full ? 4 : 1) + drop("left", -1.2) + drop("right", 1.2) +
          wall("left", "contact_angle = 60\n" + lengths) +
          wall("right", "contact_angle = 60\n" + lengths) +
          "[[contact]]\nname = \"between\"\nbodies = [\"left\", \"right\"]\ninteraction = "
          "\"smooth_young\"\nadhesion = 0.5\noffset = 0.1\nrange = 0.2\npoints = 3\n",
      1e-2);
}

/// A tip is pulled out of a film, and a neck of liquid forms. For water and a tip of 5 nm the speed
/// is 120 m/s.
void neck(HardCases& cases, bool full) {
  const std::string name = "tip is drawn out of a film, with a neck";
  const auto outcome = cases.stays_stable(
      name,
      fmt::format(
          "dimension = 3\n[time]\nend = {}\n[[body]]\nname = \"film\"\nshape = "
          "\"cylinder\"\nradius "
          "= 2.5\nheight = 0.9\ncore = 6\nrings = 3\nlayers = 2\ncentre = [0, 0, -0.45]\nmaterial "
          "= "
          "{{ type = \"newtonian\", density = 1, bulk_modulus = 151, viscosity = 0.5 }}\n"
          "[[surface_tension]]\nbody = \"film\"\ngamma = 1\n[[held]]\nbody = \"film\"\nface = "
          "\"z_min\"\n[[held]]\nbody = \"film\"\nface = \"side\"\n[[contact]]\nname = "
          "\"tip\"\nbodies = [\"film\"]\ncontact_angle = 5\n{}points = 3\n[contact.partner]\ntype "
          "= "
          "\"ball\"\ncentre = [0, 0, 1.04]\nradius = 0.95\ndisplacement = [0, 0, \"max(0, t - "
          "{})\"]\n",
          full ? 20 : 4, "offset = 0.05\nrange = 0.18\n", full ? 4 : 1),
      1e-2);
  cases.require(name, "wetted area of the tip / (4 pi R^2)",
                outcome.measure("tip.wetted_area") / (4 * 3.14159), {0, full ? 0.01 : 0.5});
}

/// A 2D drop on a layer with Young's modulus E: (adhesion + actin) / (E x range) = 6.7/E.
std::string drop_on_ground(Real modulus) {
  return fmt::format(
      "dimension = 2\n[time]\nend = 2\nviscosity = \"implicit\"\n[[body]]\nname = "
      "\"drop\"\nshape = \"disk\"\nradius = 1\ncore = 8\nrings = 4\ncentre = [0, 1.06]\nmaterial = "
      "{{ type = \"newtonian\", density = 1, bulk_modulus = 150, viscosity = 0.524 }}\n"
      "[[surface_tension]]\nbody = \"drop\"\ngamma = 1\n[[body]]\nname = \"layer\"\nshape = "
      "\"rectangle\"\nsize = [4, 0.95]\nspacing = 0.079\ncorner = [-2, -0.95]\nmaterial = {{ type "
      "= "
      "\"mooney_rivlin\", density = 1, youngs_modulus = {}, poissons_ratio = 0.45, c2 = 0 }}\n"
      "[[solid_viscosity]]\nbody = \"layer\"\nshear = 0.3\n[[held]]\nbody = \"layer\"\nwhere = \"y "
      "< "
      "-0.949\"\n[[contact]]\nname = \"ground\"\nbodies = [\"drop\", \"layer\"]\nup = [0, "
      "1]\nadhesion = 0.475\nactin = \"t > 0.5 ? 0.865 : 0\"\noffset = 0.04\nrange = 0.2\npoints = "
      "3\n",
      modulus);
}

/// Ground near its limit of stiffness, and beyond it.
void soft_ground(HardCases& cases) {
  cases.stays_stable("drop on ground that is just stiff enough", drop_on_ground(20.2), 1e-3);
  cases.stops("drop on ground that is far too soft", drop_on_ground(1.5),
              "the surface of 'layer' folds over: adhesion with actin / (Young's modulus x range)");
}

}  // namespace

void hard_wetting(HardCases& cases) {
  const bool full = !cases.study().brief();
  angles(cases, full);
  lengths_too_short(cases, full);
  motions(cases, full);
  neck(cases, full);
  soft_ground(cases);
}

}  // namespace meniscus::study
