// SPDX-License-Identifier: BSD-3-Clause
// Hollow bodies: shells of even thickness.
#include "body/shapes/wall.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus {

namespace {

template <class Shell>
Rows<Shell> wall_rows() {
  return {
      real_row<Shell>("thickness", &Shell::thickness, dimension::length, range::positive,
                      "of the wall"),
      integer_row<Shell>("layers", &Shell::layers, {3, 1000},
                         "particles through the wall, the first and the last on its surfaces", 4),
      real_row<Shell>("spacing", &Shell::spacing, dimension::length, range::positive,
                      "largest distance of particles along the outer surface from pole to "
                      "pole"),
      reals_row<Shell>("centre", &Shell::centre, 3, dimension::length, range::any, "centre",
                       std::vector<Real>{0, 0, 0})};
}

template <class Shell>
Rows<Shell> with_wall(Rows<Shell> rows) {
  const Rows<Shell> wall = wall_rows<Shell>();
  rows.insert(rows.end(), wall.begin(), wall.end());
  return rows;
}

Geometry<3> wall_of(const Wall& shell, const Meridian& meridian) {
  return make_wall(meridian, shell.thickness, shell.layers, shell.spacing,
                   Vec<3>::Map(shell.centre.data()));
}

/// The section of a shell through its axis, along y of the plane: the shell itself as a body of
/// revolution.
template <class Shell>
struct Section : Shell {
  static constexpr const char* name = Shell::name;
  static constexpr const char* meaning =
      "section through the axis of a shell of that name in 3D; a body of revolution is that shell";
  static constexpr std::string_view example = Shell::example;

  static Rows<Section> rows() {
    Rows<Section> rows;
    for (const Row<Shell>& row : Shell::rows())
      if (row.key != "centre")
        rows.push_back(
            {row.key, row.type, row.unit, row.range, row.fallback, row.meaning,
             [read = row.read](Section& section, const Block& block) { read(section, block); }});
    rows.push_back(reals_row<Section>("centre", &Section::centre, 2, dimension::length, range::any,
                                      "centre", std::vector<Real>{0, 0}));
    return rows;
  }
  Geometry<2> geometry() const {
    return make_wall_section(this->meridian(), this->thickness, this->layers, this->spacing,
                             Vec<2>::Map(this->centre.data()));
  }
};

const bool shell_registered =
    register_shape<3, DiskShell>() && register_shape<3, CylinderShell>() &&
    register_shape<3, SpheroidShell>() && register_shape<3, SphereShell>() &&
    register_shape<2, Section<DiskShell>>() && register_shape<2, Section<CylinderShell>>() &&
    register_shape<2, Section<SpheroidShell>>() && register_shape<2, Section<SphereShell>>();

}  // namespace

Rows<DiskShell> DiskShell::rows() {
  return with_wall<DiskShell>(
      {real_row("radius", &DiskShell::radius, dimension::length, range::positive, "outer radius"),
       real_row("height", &DiskShell::height, dimension::length, range::positive,
                "outer extent along z, twice the radius of the rim")});
}

Geometry<3> DiskShell::geometry() const {
  return wall_of(*this, meridian());
}

Meridian DiskShell::meridian() const {
  if (height > 2 * radius)
    throw InputError(fmt::format(
        "a disk of radius {:g} cannot have a round rim of the height {:g}: at most {:g}", radius,
        height, 2 * radius));
  return rounded_cylinder_meridian(radius, height, 0.5 * height);
}

Rows<CylinderShell> CylinderShell::rows() {
  return with_wall<CylinderShell>(
      {real_row("radius", &CylinderShell::radius, dimension::length, range::positive,
                "outer radius"),
       real_row("height", &CylinderShell::height, dimension::length, range::positive,
                "outer extent along z"),
       real_row("edge_radius", &CylinderShell::edge_radius, dimension::length, range::positive,
                "outer radius to which the edges are rounded")});
}

Geometry<3> CylinderShell::geometry() const {
  return wall_of(*this, meridian());
}

Meridian CylinderShell::meridian() const {
  const Real largest = std::min(radius, 0.5 * height);
  if (edge_radius > largest)
    throw InputError(fmt::format("the edge radius is {:g}, but the cylinder allows at most {:g}",
                                 edge_radius, largest));
  return rounded_cylinder_meridian(radius, height, edge_radius);
}

Rows<SpheroidShell> SpheroidShell::rows() {
  return with_wall<SpheroidShell>({real_row("radius", &SpheroidShell::radius, dimension::length,
                                            range::positive, "outer radius at the equator"),
                                   real_row("height", &SpheroidShell::height, dimension::length,
                                            range::positive, "outer extent along z")});
}

Geometry<3> SpheroidShell::geometry() const {
  return wall_of(*this, meridian());
}

Meridian SpheroidShell::meridian() const {
  return spheroid_meridian(radius, height);
}

Rows<SphereShell> SphereShell::rows() {
  return with_wall<SphereShell>({real_row("radius", &SphereShell::radius, dimension::length,
                                          range::positive, "outer radius")});
}

Geometry<3> SphereShell::geometry() const {
  return wall_of(*this, meridian());
}

Meridian SphereShell::meridian() const {
  return rounded_cylinder_meridian(radius, 2 * radius, radius);
}

}  // namespace meniscus
