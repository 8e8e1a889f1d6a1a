// SPDX-License-Identifier: BSD-3-Clause
// Half sphere: the upper half of the cubed sphere.
#include "meniscus/body/cell_count.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/core/error.hpp"

#include <algorithm>

#include "cubed.hpp"

namespace meniscus {

namespace {

/// The cells above z = 0 and their nodes; an even core has nodes, and no cells, across that plane.
Grid<3> upper_half(const Grid<3>& whole) {
  Grid<3> half;
  std::vector<Index> number(whole.X.size(), -1);
  for (const auto& cell : whole.cells) {
    if (std::any_of(cell.begin(), cell.end(), [&](Index a) { return at(whole.X, a)[2] < 0; }))
      continue;
    auto& own = half.cells.emplace_back(cell);
    for (Index& node : own) {
      Index& known = at(number, node);
      if (known < 0) {
        known = half.node_count();
        half.X.push_back(at(whole.X, node));
      }
      node = known;
    }
  }
  return half;
}

const bool half_sphere_registered = register_shape<3, HalfSphere>();

}  // namespace

Rows<HalfSphere> HalfSphere::rows() {
  return {real_row("radius", &HalfSphere::radius, dimension::length, range::positive, "radius"),
          integer_row("core", &HalfSphere::core, count_in_space,
                      "cells along an edge of the core of the whole ball, an even number", 10),
          integer_row("layers", &HalfSphere::layers, count_in_space,
                      "shells of cells around the core", 5),
          reals_row("centre", &HalfSphere::centre, 3, dimension::length, range::any,
                    "centre of the flat face", std::vector<Real>{0, 0, 0})};
}

Geometry<3> HalfSphere::geometry() const {
  if (core % 2 != 0)
    throw InputError(
        "a half sphere has an even number of cells along the core; use a multiple of 2");
  const Vec<3> origin = Vec<3>::Zero(), z = Vec<3>::UnitZ();
  return make_geometry<3>(
      upper_half(cubed_ball<3>(core, layers)),
      {SurfacePatch<3>::sphere(origin, 1).named("round"),
       SurfacePatch<3>::plane(origin, -z).named("flat")},
      false, affine_map<3>(Vec<3>::Constant(radius).asDiagonal(), Vec<3>::Map(centre.data())));
}

}  // namespace meniscus
