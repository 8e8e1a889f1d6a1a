// SPDX-License-Identifier: BSD-3-Clause
// Disk and ellipse.
#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "body/shapes/spacing.hpp"
#include "meniscus/body/shapes.hpp"

#include <cmath>

namespace meniscus {

namespace {

Geometry<2> stretched_disk(const Vec<2>& semi_axes, int core, int rings,
                           const std::vector<Real>& centre) {
  return make_geometry<2>(cubed_ball<2>(core, rings),
                          {SurfacePatch<2>::sphere(Vec<2>::Zero(), 1).named("rim")}, true,
                          affine_map<2>(semi_axes.asDiagonal(), Vec<2>::Map(centre.data())));
}

const bool disk_registered = register_shape<2, Disk>() && register_shape<2, Ellipse>();

}  // namespace

Rows<Disk> Disk::rows() {
  return with_round_spacing<Disk>(
      {real_row("radius", &Disk::radius, dimension::length, range::positive, "radius"),
       integer_row("core", &Disk::core, count_in_plane, "cells along an edge of the core square",
                   18),
       integer_row("rings", &Disk::rings, count_in_plane, "rings of cells around the core", 9),
       reals_row("centre", &Disk::centre, 2, dimension::length, range::any, "centre",
                 std::vector<Real>{0, 0})},
      &Disk::core, &Disk::rings, "rings", [](const Disk& disk) { return disk.radius; });
}

Geometry<2> Disk::geometry() const {
  return stretched_disk(Vec<2>::Constant(radius), core, rings, centre);
}

Rows<Ellipse> Ellipse::rows() {
  return with_round_spacing<Ellipse>(
      {reals_row("semi_axes", &Ellipse::semi_axes, 2, dimension::length, range::positive,
                 "semi-axes along x, y"),
       integer_row("core", &Ellipse::core, count_in_plane, "cells along an edge of the core square",
                   18),
       integer_row("rings", &Ellipse::rings, count_in_plane, "rings of cells around the core", 9),
       reals_row("centre", &Ellipse::centre, 2, dimension::length, range::any, "centre",
                 std::vector<Real>{0, 0})},
      &Ellipse::core, &Ellipse::rings, "rings",
      [](const Ellipse& e) { return std::sqrt(at(e.semi_axes, 0) * at(e.semi_axes, 1)); });
}

Geometry<2> Ellipse::geometry() const {
  return stretched_disk(Vec<2>::Map(semi_axes.data()), core, rings, centre);
}

}  // namespace meniscus
