// SPDX-License-Identifier: BSD-3-Clause
// Half sphere: the upper half of the cubed sphere, or the lower one.
#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "body/shapes/spacing.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"

namespace meniscus {

namespace {

const bool half_sphere_registered = register_shape<3, HalfSphere>();

}  // namespace

Rows<HalfSphere> HalfSphere::rows() {
  return with_round_spacing<HalfSphere>(
      {real_row("radius", &HalfSphere::radius, dimension::length, range::positive, "radius"),
       integer_row("core", &HalfSphere::core, count_in_space,
                   "cells along an edge of the core of the whole ball, an even number", 10),
       integer_row("layers", &HalfSphere::layers, count_in_space, "shells of cells around the core",
                   5),
       reals_row("centre", &HalfSphere::centre, 3, dimension::length, range::any,
                 "centre of the flat face", std::vector<Real>{0, 0, 0}),
       flag_row("below", &HalfSphere::below, "whether it is the half below its flat face", false)},
      &HalfSphere::core, &HalfSphere::layers, "layers",
      [](const HalfSphere& half) { return half.radius; });
}

Geometry<3> HalfSphere::geometry() const {
  if (core % 2 != 0)
    throw InputError(
        "a half sphere has an even number of cells along the core; use a multiple of 2");
  // The lower half is the upper one turned about x.
  const Vec<3> scale = below ? Vec<3>(radius, -radius, -radius) : Vec<3>::Constant(radius);
  const Vec<3> origin = Vec<3>::Zero(), z = Vec<3>::UnitZ();
  return make_geometry<3>(upper_half<3>(cubed_ball<3>(core, layers)),
                          {SurfacePatch<3>::sphere(origin, 1).named("round"),
                           SurfacePatch<3>::plane(origin, -z).named("flat")},
                          false, affine_map<3>(scale.asDiagonal(), Vec<3>::Map(centre.data())));
}

}  // namespace meniscus
