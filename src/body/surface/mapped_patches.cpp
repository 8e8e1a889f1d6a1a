// SPDX-License-Identifier: BSD-3-Clause
// Surfaces made of mapped patches.
#include "body/surface/mapped_patches.hpp"

#include "body/surface/facet_quadrature.hpp"
#include "body/surface/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace meniscus {

template <int D>
SurfacePatch<D> SurfacePatch<D>::plane(const Vec<D>& point, const Vec<D>& normal) {
  return {point, Mat<D>::Zero(), normal.normalized(), 0};
}

template <int D>
SurfacePatch<D> SurfacePatch<D>::sphere(const Vec<D>& centre, Real radius) {
  return {centre, Mat<D>::Identity(), Vec<D>::Zero(), radius};
}

template <int D>
SurfacePatch<D> SurfacePatch<D>::cavity(const Vec<D>& centre, Real radius) {
  return sphere(centre, -radius);
}

template <int D>
SurfacePatch<D> SurfacePatch<D>::cylinder(const Vec<D>& point, const Vec<D>& axis, Real radius) {
  return {point, Mat<D>::Identity() - axis * axis.transpose(), Vec<D>::Zero(), radius};
}

template <int D>
typename SurfacePatch<D>::Foot SurfacePatch<D>::project(const Vec<D>& X) const {
  if (radius == 0)
    return {X - normal * normal.dot(X - origin), normal, Mat<D>::Zero(),
            Mat<D>::Identity() - normal * normal.transpose()};
  const Vec<D> arm = round * (X - origin);
  const Real r = std::copysign(arm.norm(), radius);
  const Vec<D> N = arm / r;
  const Mat<D> tangential = round - N * N.transpose();
  return {X - arm + radius * N, N, tangential / radius,
          Mat<D>::Identity() - round + (radius / r) * tangential};
}

namespace {

/// The point of a facet in the unit shape. Edges between two patches lie on both, e.g. at the rim
/// of a cylinder: the shift of an edge onto the other patch fades out linearly across the facet.
template <int D>
CellPoint<D, D - 1> blended(const MappedPatches<D>& surface, const Facet<D>& facet,
                            const Vec<D - 1>& xi) {
  const FacetCorners<D> corners = facet_corners(facet, surface.unit_X());
  CellPoint<D, D - 1> point = multilinear<D, D - 1>(corners, xi);
  if constexpr (D == 3)
    for (int edge = 0; edge < 4; ++edge) {
      const int beyond = at(facet.patch_beyond, edge), across = edge / 2, along = 1 - across;
      if (beyond < 0 || beyond == facet.patch) continue;
      const Real end = edge % 2 ? 1 : -1;
      Vec<2> on_edge = xi;
      on_edge[across] = end;
      const CellPoint<3, 2> straight = multilinear<3, 2>(corners, on_edge);
      const auto foot = at(surface.patches(), beyond).project(straight.X);
      const Vec<3> tangent = straight.J.col(along), move = foot.X - straight.X;
      const Real fade = 0.5 * (1 + end * xi[across]);
      point.X += fade * move;
      point.J.col(across) += 0.5 * end * move;
      point.J.col(along) += fade * (foot.derivative * tangent - tangent);
    }
  return point;
}

}  // namespace

template <int D>
MappedPatches<D>::MappedPatches(std::vector<Vec<D>> unit_X, std::vector<SurfacePatch<D>> patches,
                                bool smooth, SmoothMap<D> map)
    : unit_X_(std::move(unit_X)),
      patches_(std::move(patches)),
      smooth_(smooth),
      map_(std::move(map)) {}

template <int D>
SurfacePoints<D> MappedPatches<D>::points(const Grid<D>& grid, int k, SurfacePart part) const {
  const auto wanted = [&](const Facet<D>& facet) {
    return part == SurfacePart::whole ||
           at(patches_, facet.patch).inner() == (part == SurfacePart::inner);
  };
  const auto at_place = [&](const Facet<D>& facet, const Vec<D - 1>& xi, Real w) {
    const CellPoint<D, D - 1> p = blended(*this, facet, xi);
    const auto foot = at(patches_, facet.patch).project(p.X);
    const Real area = area_normal<D>(foot.derivative * p.J).norm();
    return FacetPoint<D>{foot.X, foot.N, foot.grad_N, w * area};
  };
  SurfacePoints<D> points = points_of_facets(grid, k, wanted, at_place);
  points.exact = true;
  deform(points, map_);
  return points;
}

template <int D>
Vec<D> MappedPatches<D>::point(const Grid<D>&, const Facet<D>& facet, const Vec<D - 1>& xi) const {
  return map_(at(patches_, facet.patch).project(blended(*this, facet, xi).X).X).x;
}

template <int D>
bool MappedPatches<D>::hollow() const {
  return std::any_of(patches_.begin(), patches_.end(),
                     [](const SurfacePatch<D>& patch) { return patch.inner(); });
}

template <int D>
std::shared_ptr<const Surface<D>> MappedPatches<D>::renumbered(std::span<const Index> order) const {
  std::vector<Vec<D>> unit_X;
  for (const Index i : order) unit_X.push_back(at(unit_X_, i));
  return std::make_shared<MappedPatches>(std::move(unit_X), patches_, smooth_, map_);
}

template <int D>
std::shared_ptr<const Surface<D>> MappedPatches<D>::mapped(const SmoothMap<D>& map,
                                                           const Grid<D>&) const {
  return std::make_shared<MappedPatches>(unit_X_, patches_, smooth_, compose<D>(map, map_));
}

template <int D>
const MappedPatches<D>& mapped_patches(const Surface<D>& surface) {
  if (const auto* patches = dynamic_cast<const MappedPatches<D>*>(&surface)) return *patches;
  throw std::logic_error("the surface of the body is not known by patches");
}

#define MENISCUS_INSTANTIATE(D)    \
  template struct SurfacePatch<D>; \
  template class MappedPatches<D>; \
  template const MappedPatches<D>& mapped_patches(const Surface<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
