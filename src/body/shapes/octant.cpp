// SPDX-License-Identifier: BSD-3-Clause
// Octant: an eighth of a ball between three planes. Rollers on these planes make them planes of
// symmetry.
#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "body/shapes/spacing.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"

namespace meniscus {
namespace {

struct Octant {
  static constexpr const char* name = "octant";
  static constexpr const char* meaning = "eighth of a ball with x, y, z above its corner";
  static constexpr std::string_view example = "radius = 1\ncore = 4\nlayers = 2\n";
  Real radius = 1;
  int core = 10, layers = 5;
  Real grading = 1;
  std::vector<Real> corner{0, 0, 0};

  static Rows<Octant> rows() {
    return with_round_spacing<Octant>(
        {real_row("radius", &Octant::radius, dimension::length, range::positive, "radius"),
         integer_row("core", &Octant::core, count_in_space,
                     "cells along an edge of the core of the whole ball, an even number", 10),
         integer_row("layers", &Octant::layers, count_in_space, "shells of cells around the core",
                     5),
         grading_row(&Octant::grading),
         reals_row("corner", &Octant::corner, 3, dimension::length, range::any,
                   "centre of the whole ball", std::vector<Real>{0, 0, 0})},
        &Octant::core, &Octant::layers, "layers",
        [](const Octant& octant) { return octant.radius; });
  }
  Geometry<3> geometry() const {
    if (core % 2 != 0)
      throw InputError("an octant has an even number of cells along the core; use a multiple of 2");
    const Vec<3> origin = Vec<3>::Zero();
    Grid<3> grid = cubed_ball<3>(core, layers, grading);
    std::vector<SurfacePatch<3>> patches = {SurfacePatch<3>::sphere(origin, 1).named("round")};
    for (int k = 0; k < 3; ++k) {
      grid = upper_half<3>(grid, k);
      patches.push_back(SurfacePatch<3>::plane(origin, -Vec<3>::Unit(k))
                            .named(std::string(1, "xyz"[k]) + "_min"));
    }
    return make_geometry<3>(
        std::move(grid), std::move(patches), false,
        affine_map<3>(Vec<3>::Constant(radius).asDiagonal(), Vec<3>::Map(corner.data())));
  }
};

const bool octant_registered = register_shape<3, Octant>();

}  // namespace
}  // namespace meniscus
