// SPDX-License-Identifier: BSD-3-Clause
// Reference bodies of surface studies.
#include "study/support/bodies.hpp"

#include "body/grid/ordering.hpp"
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace meniscus::study {
namespace {

template <int D>
Geometry<D> brick(int n) {
  Brick<D> shape;
  shape.size.assign(D, 2);
  shape.cells.assign(D, n);
  return shape.geometry();
}

template <int D>
Geometry<D> geometry_of(const std::string& shape, int n);

template <>
Geometry<3> geometry_of(const std::string& shape, int n) {
  const int shells = std::max(1, n / 2);
  if (shape == "box") return brick<3>(n);
  if (shape == "cylinder")
    return Cylinder{.height = 2, .core = n, .rings = shells, .layers = n}.geometry();
  return Ball{.core = n, .layers = shells}.geometry();
}

template <>
Geometry<2> geometry_of(const std::string& shape, int n) {
  if (shape == "rectangle") return brick<2>(n);
  return Disk{.core = n, .rings = std::max(1, n / 2)}.geometry();
}

}  // namespace

template <>
const std::vector<std::string>& reference_shapes<2>() {
  static const std::vector<std::string> names{"disk", "rectangle"};
  return names;
}
template <>
const std::vector<std::string>& reference_shapes<3>() {
  static const std::vector<std::string> names{"ball", "box", "cylinder"};
  return names;
}

template <int D>
Geometry<D> reference_body(const std::string& shape, int n) {
  Geometry<D> geometry = geometry_of<D>(shape, n);
  order_spatially(geometry);
  return geometry;
}

template <int D>
void require_curvature(const std::string& shape, const Geometry<D>& geometry) {
  if (!geometry.surface->smooth())
    throw InputError(fmt::format(
        "the shape '{}' has edges; the normal jumps there, 2 kappa = -div n is infinite, and so "
        "the error of a curvature is undefined; study the {}; a simulation of this shape takes the "
        "weak form of surface tension, which needs no curvature",
        shape, reference_shapes<D>()[0]));
}

template Geometry<2> reference_body(const std::string&, int);
template Geometry<3> reference_body(const std::string&, int);
template void require_curvature(const std::string&, const Geometry<2>&);
template void require_curvature(const std::string&, const Geometry<3>&);

}  // namespace meniscus::study
