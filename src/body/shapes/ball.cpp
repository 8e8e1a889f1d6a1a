// SPDX-License-Identifier: BSD-3-Clause
// Ball and ellipsoid.
#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "body/shapes/spacing.hpp"
#include "meniscus/body/shapes.hpp"

#include <cmath>

namespace meniscus {

namespace {

Geometry<3> stretched_ball(const Vec<3>& semi_axes, int core, int layers,
                           const std::vector<Real>& centre) {
  return make_geometry<3>(cubed_ball<3>(core, layers),
                          {SurfacePatch<3>::sphere(Vec<3>::Zero(), 1).named("surface")}, true,
                          affine_map<3>(semi_axes.asDiagonal(), Vec<3>::Map(centre.data())));
}

const bool ball_registered = register_shape<3, Ball>() && register_shape<3, Ellipsoid>();

}  // namespace

Rows<Ball> Ball::rows() {
  return with_round_spacing<Ball>(
      {real_row("radius", &Ball::radius, dimension::length, range::positive, "radius"),
       integer_row("core", &Ball::core, count_in_space, "cells along an edge of the core cube", 10),
       integer_row("layers", &Ball::layers, count_in_space, "shells of cells around the core", 5),
       reals_row("centre", &Ball::centre, 3, dimension::length, range::any, "centre",
                 std::vector<Real>{0, 0, 0})},
      &Ball::core, &Ball::layers, "layers", [](const Ball& ball) { return ball.radius; });
}

Geometry<3> Ball::geometry() const {
  return stretched_ball(Vec<3>::Constant(radius), core, layers, centre);
}

Rows<Ellipsoid> Ellipsoid::rows() {
  return with_round_spacing<Ellipsoid>(
      {reals_row("semi_axes", &Ellipsoid::semi_axes, 3, dimension::length, range::positive,
                 "semi-axes along x, y, z"),
       integer_row("core", &Ellipsoid::core, count_in_space, "cells along an edge of the core cube",
                   10),
       integer_row("layers", &Ellipsoid::layers, count_in_space, "shells of cells around the core",
                   5),
       reals_row("centre", &Ellipsoid::centre, 3, dimension::length, range::any, "centre",
                 std::vector<Real>{0, 0, 0})},
      &Ellipsoid::core, &Ellipsoid::layers, "layers", [](const Ellipsoid& e) {
        return std::cbrt(at(e.semi_axes, 0) * at(e.semi_axes, 1) * at(e.semi_axes, 2));
      });
}

Geometry<3> Ellipsoid::geometry() const {
  return stretched_ball(Vec<3>::Map(semi_axes.data()), core, layers, centre);
}

}  // namespace meniscus
