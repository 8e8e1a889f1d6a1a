// SPDX-License-Identifier: BSD-3-Clause
// Ring: the cross section of a thick-walled cylinder.
#include "body/shapes/cell_count.hpp"
#include "body/shapes/cubed.hpp"
#include "body/shapes/spacing.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <numbers>

namespace meniscus {
namespace {

const bool ring_registered = register_shape<2, Ring>();

}  // namespace

Rows<Ring> Ring::rows() {
  return with_spacing<Ring>(
      {real_row("radius", &Ring::radius, dimension::length, range::positive, "outer radius"),
       real_row("thickness", &Ring::thickness, dimension::length, range::positive,
                "of the wall, less than the radius"),
       integer_row("around", &Ring::around, {6, 1e6}, "cells around", 48),
       integer_row("layers", &Ring::layers, {2, 1e6}, "cells through the wall", 6),
       reals_row("centre", &Ring::centre, 2, dimension::length, range::any, "centre",
                 std::vector<Real>{0, 0})},
      {"around", "layers"},
      "mean size of a cell: around is the length of the middle circle / spacing, a multiple of 4, "
      "and layers are thickness / spacing, at least 2",
      [](Ring& ring, Real spacing) {
        ring.around = cells_of_spacing(2 * std::numbers::pi * (ring.radius - ring.thickness / 2),
                                       spacing, 4, 8);
        ring.layers = cells_of_spacing(ring.thickness, spacing, 1, 2);
      });
}

Geometry<2> Ring::geometry() const {
  if (!(thickness < radius))
    throw InputError(fmt::format("a ring of radius {:g} has no wall {:g} thick: it has to be less",
                                 radius, thickness));
  require_affordable<2>(Real(around) * layers);
  const Real inside = 1 - thickness / radius;
  const Vec<2> middle = Vec<2>::Map(centre.data());
  Geometry<2> geometry =
      make_geometry<2>(unit_ring(around, layers, inside),
                       {SurfacePatch<2>::sphere(Vec<2>::Zero(), 1).named("outer"),
                        SurfacePatch<2>::cavity(Vec<2>::Zero(), inside).named("inner")},
                       true, affine_map<2>(Mat<2>(Mat<2>::Identity() * radius), middle));
  geometry.director = [=](const Vec<2>& X) -> Vec<2> { return (X - middle).normalized(); };
  return geometry;
}

}  // namespace meniscus
