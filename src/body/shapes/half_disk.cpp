// SPDX-License-Identifier: BSD-3-Clause
// Half disk: the upper half of the disk, or the lower one.
#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "body/shapes/spacing.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"

namespace meniscus {
namespace {

struct HalfDisk {
  static constexpr const char* name = "half_disk";
  static constexpr const char* meaning = "half disk above its flat face y = 0, or below it";
  static constexpr std::string_view example = "radius = 1\ncore = 4\nrings = 2\n";
  Real radius = 1;
  int core = 18, rings = 9;
  Real grading = 1;
  bool below = false;
  std::vector<Real> centre{0, 0};

  static Rows<HalfDisk> rows() {
    return with_round_spacing<HalfDisk>(
        {real_row("radius", &HalfDisk::radius, dimension::length, range::positive, "radius"),
         integer_row("core", &HalfDisk::core, count_in_plane,
                     "cells along an edge of the core square of the whole disk, an even number",
                     18),
         integer_row("rings", &HalfDisk::rings, count_in_plane, "rings of cells around the core",
                     9),
         grading_row(&HalfDisk::grading),
         flag_row("below", &HalfDisk::below, "whether it is the half below its flat face", false),
         reals_row("centre", &HalfDisk::centre, 2, dimension::length, range::any,
                   "centre of the flat face", std::vector<Real>{0, 0})},
        &HalfDisk::core, &HalfDisk::rings, "rings",
        [](const HalfDisk& half) { return half.radius; });
  }
  Geometry<2> geometry() const {
    if (core % 2 != 0)
      throw InputError(
          "a half disk has an even number of cells along the core; use a multiple of 2");
    const Vec<2> origin = Vec<2>::Zero(), y = Vec<2>::UnitY();
    const Vec<2> scale = Vec<2>::Constant(below ? -radius : radius);  // turned for the lower half
    return make_geometry<2>(upper_half<2>(cubed_ball<2>(core, rings, grading)),
                            {SurfacePatch<2>::sphere(origin, 1).named("round"),
                             SurfacePatch<2>::plane(origin, -y).named("flat")},
                            false, affine_map<2>(scale.asDiagonal(), Vec<2>::Map(centre.data())));
  }
};

const bool half_disk_registered = register_shape<2, HalfDisk>();

}  // namespace
}  // namespace meniscus
