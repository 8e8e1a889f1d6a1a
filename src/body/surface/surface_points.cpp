// SPDX-License-Identifier: BSD-3-Clause
// Surface quadrature on patches and facets, and its transport by maps.
#include "body/surface/surface_points.hpp"

#include "body/surface/facet_quadrature.hpp"
#include "numbers/surface_geometry.hpp"
#include "parallel/parallel.hpp"

#include <cmath>

namespace meniscus {

namespace {

/// Multiplies areas by the circles of the points.
template <int D>
void take_circles(const Grid<D>& grid, SurfacePoints<D>& points) {
  if (!grid.revolved) return;
  for (Index q = 0; q < points.size(); ++q) at(points.area, q) *= circle(grid, at(points.X, q));
}

}  // namespace

template <int D>
SurfacePoints<D> facet_points(const Grid<D>& grid, int k) {
  const auto every = [](const Facet<D>&) { return true; };
  auto points =
      points_of_facets(grid, k, every, [&](const Facet<D>& facet, const Vec<D - 1>& xi, Real w) {
        const auto p = multilinear<D, D - 1>(facet_corners(facet, grid.X), xi);
        const Vec<D> normal = area_normal<D>(p.J);
        return FacetPoint<D>{p.X, normal.normalized(), Mat<D>::Zero(), w * normal.norm()};
      });
  take_circles(grid, points);
  return points;
}

template <int D>
SurfacePoints<D> surface_points(const Geometry<D>& geometry, int k, SurfacePart part) {
  auto points = geometry.surface->points(geometry.grid, k, part);
  take_circles(geometry.grid, points);
  return points;
}

template <int D>
Vec<D> surface_point(const Geometry<D>& geometry, const Facet<D>& facet, const Vec<D - 1>& xi) {
  Vec<D> X = geometry.surface->point(geometry.grid, facet, xi);
  if constexpr (D == 2)
    if (geometry.grid.revolved && std::abs(xi[0]) == 1 &&
        at(geometry.grid.X, at(facet.nodes, xi[0] > 0 ? 1 : 0))[0] == 0)
      X[0] = 0;
  return X;
}

template <int D>
void deform(SurfacePoints<D>& points, const SmoothMap<D>& map) {
  parallel_for(points.size(), [&](Index q) {
    const MapPoint<D> m = map(at(points.X, q));
    const SurfaceFrame<Real> frame = surface_frame(embed<D>(m.F, 1), embed<D>(at(points.N, q)));
    std::array<Tensor<Real>, 3> G{Tensor<Real>::zero(), Tensor<Real>::zero(), Tensor<Real>::zero()};
    for (int i = 0; i < D; ++i) at(G, i) = embed<D>(at(m.G, i), 0);
    const Tensor<Real> grad_n =
        normal_gradient(frame, contract_normal(frame.n, G), embed<D>(at(points.grad_N, q), 0));
    at(points.X, q) = m.x;
    at(points.area, q) *= frame.area_ratio;
    for (int i = 0; i < D; ++i) {
      at(points.N, q)[i] = at(frame.n, i);
      for (int j = 0; j < D; ++j) at(points.grad_N, q)(i, j) = grad_n(i, j);
    }
  });
}

#define MENISCUS_INSTANTIATE(D)                                                          \
  template SurfacePoints<D> surface_points(const Geometry<D>&, int, SurfacePart);        \
  template Vec<D> surface_point(const Geometry<D>&, const Facet<D>&, const Vec<D - 1>&); \
  template SurfacePoints<D> facet_points(const Grid<D>&, int);                           \
  template void deform(SurfacePoints<D>&, const SmoothMap<D>&);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
