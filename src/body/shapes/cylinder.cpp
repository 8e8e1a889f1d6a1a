// SPDX-License-Identifier: BSD-3-Clause
// Cylinder: the disk repeated along z.
#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "body/shapes/spacing.hpp"
#include "meniscus/body/shapes.hpp"

namespace meniscus {

namespace {

/// The cylinder of radius 1 with -1/2 <= z <= 1/2.
Grid<3> unit_cylinder(int core, int rings, int layers) {
  const Grid<2> disk = cubed_ball<2>(core, rings);
  require_affordable<3>(Real(layers) * disk.cell_count());
  Grid<3> grid;
  for (int layer = 0; layer <= layers; ++layer)
    for (const auto& X : disk.X) grid.X.emplace_back(X[0], X[1], Real(layer) / layers - 0.5);
  for (int layer = 0; layer < layers; ++layer)
    for (const auto& quad : disk.cells) {
      Grid<3>::Cell cell;
      for (int a = 0; a < 8; ++a)
        at(cell, a) = at(quad, a % 4) + (layer + a / 4) * disk.node_count();
      grid.cells.push_back(cell);
    }
  return grid;
}

const bool cylinder_registered = register_shape<3, Cylinder>();

}  // namespace

Rows<Cylinder> Cylinder::rows() {
  return with_spacing<Cylinder>(
      {real_row("radius", &Cylinder::radius, dimension::length, range::positive, "radius"),
       real_row("height", &Cylinder::height, dimension::length, range::positive, "extent along z"),
       integer_row("core", &Cylinder::core, count_in_space,
                   "cells along an edge of the core square", 18),
       integer_row("rings", &Cylinder::rings, count_in_space, "rings of cells around the core", 9),
       integer_row("layers", &Cylinder::layers, count_in_space, "layers of cells along z", 3),
       reals_row("centre", &Cylinder::centre, 3, dimension::length, range::any, "centre",
                 std::vector<Real>{0, 0, 0})},
      {"core", "rings", "layers"},
      "mean size of a cell: core is radius / spacing, an even number, rings are half as many, and "
      "layers are height / spacing",
      [](Cylinder& cylinder, Real spacing) {
        const RoundCells disk = round_cells(cylinder.radius, spacing);
        cylinder.core = disk.core;
        cylinder.rings = disk.shells;
        cylinder.layers = cells_of_spacing(cylinder.height, spacing);
      });
}

Geometry<3> Cylinder::geometry() const {
  const Vec<3> z = Vec<3>::UnitZ(), top = 0.5 * z;
  return make_geometry<3>(
      unit_cylinder(core, rings, layers),
      {SurfacePatch<3>::cylinder(Vec<3>::Zero(), z, 1).named("side"),
       SurfacePatch<3>::plane(-top, -z).named("z_min"),
       SurfacePatch<3>::plane(top, z).named("z_max")},
      false,
      affine_map<3>(Vec<3>(radius, radius, height).asDiagonal(), Vec<3>::Map(centre.data())));
}

}  // namespace meniscus
