// SPDX-License-Identifier: BSD-3-Clause
// Surface quadrature on patches and facets, and its transport by maps.
#include "meniscus/body/surface_points.hpp"

#include "meniscus/body/gauss.hpp"
#include "meniscus/core/surface_geometry.hpp"

#include <Eigen/Geometry>

namespace meniscus {

namespace {

/// Normal whose length is the area spanned by the tangents; outward for outward facets.
template <int D>
Vec<D> area_normal(const Eigen::Matrix<Real, D, D - 1>& tangents) {
  if constexpr (D == 3)
    return tangents.col(0).cross(tangents.col(1));
  else
    return Vec<2>(tangents(1, 0), -tangents(0, 0));
}

template <int D>
void append(SurfacePoints<D>& points, const Vec<D>& X, const Vec<D>& N, const Mat<D>& grad_N,
            Real area, Index facet) {
  points.X.push_back(X);
  points.N.push_back(N);
  points.grad_N.push_back(grad_N);
  points.area.push_back(area);
  points.facet.push_back(facet);
}

template <int D>
using FacetCorners = std::array<Vec<D>, (1 << (D - 1))>;

template <int D>
FacetCorners<D> facet_corners(const Facet<D>& facet, const std::vector<Vec<D>>& X) {
  FacetCorners<D> corners;
  for (std::size_t a = 0; a < corners.size(); ++a) corners[a] = at(X, facet.nodes[a]);
  return corners;
}

/// Calls f(facet number, xi, weight) for the Gauss points of every facet that is wanted; returns
/// points per facet.
template <int D, class Wanted, class F>
int for_facet_points(const Grid<D>& grid, int k, Wanted&& wanted, F&& f) {
  const TensorRule<D - 1> rule = tensor_rule<D - 1>(k);
  for (std::size_t i = 0; i < grid.facets.size(); ++i)
    for (std::size_t q = 0; wanted(grid.facets[i]) && q < rule.x.size(); ++q)
      f(static_cast<Index>(i), rule.x[q], rule.w[q]);
  return static_cast<int>(rule.x.size());
}

/// Facet point whose edges towards other patches lie on those too, e.g. on the rim of a cylinder:
/// the move of an edge onto the other patch fades out linearly across the facet.
template <int D>
CellPoint<D, D - 1> blended(const Geometry<D>& geometry, const Facet<D>& facet,
                            const Vec<D - 1>& xi) {
  const FacetCorners<D> corners = facet_corners(facet, geometry.unit_X);
  CellPoint<D, D - 1> point = multilinear<D, D - 1>(corners, xi);
  if constexpr (D == 3)
    for (int edge = 0; edge < 4; ++edge) {
      const int beyond = at(facet.patch_beyond, edge), across = edge / 2, along = 1 - across;
      if (beyond < 0 || beyond == facet.patch) continue;
      const Real end = edge % 2 ? 1 : -1;
      Vec<2> on_edge = xi;
      on_edge[across] = end;
      const CellPoint<3, 2> straight = multilinear<3, 2>(corners, on_edge);
      const auto foot = at(geometry.patches, beyond).project(straight.X);
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
SurfacePoints<D> facet_points(const Grid<D>& grid, int k) {
  SurfacePoints<D> points;
  const auto every = [](const Facet<D>&) { return true; };
  points.per_facet = for_facet_points(grid, k, every, [&](Index i, const Vec<D - 1>& xi, Real w) {
    const auto p = multilinear<D, D - 1>(facet_corners(at(grid.facets, i), grid.X), xi);
    const Vec<D> normal = area_normal<D>(p.J);
    append<D>(points, p.X, normal.normalized(), Mat<D>::Zero(), w * normal.norm(), i);
  });
  return points;
}

template <int D>
SurfacePoints<D> surface_points(const Geometry<D>& geometry, int k, SurfacePart part) {
  SurfacePoints<D> points;
  points.exact = true;
  const auto wanted = [&](const Facet<D>& facet) {
    return part == SurfacePart::whole ||
           at(geometry.patches, facet.patch).inner() == (part == SurfacePart::inner);
  };
  points.per_facet =
      for_facet_points(geometry.grid, k, wanted, [&](Index i, const auto& xi, Real w) {
        const Facet<D>& facet = at(geometry.grid.facets, i);
        const CellPoint<D, D - 1> p = blended(geometry, facet, xi);
        const auto foot = at(geometry.patches, facet.patch).project(p.X);
        const Real area = area_normal<D>(foot.derivative * p.J).norm();
        append<D>(points, foot.X, foot.N, foot.grad_N, w * area, i);
      });
  deform(points, geometry.map);
  return points;
}

template <int D>
Vec<D> surface_point(const Geometry<D>& geometry, const Facet<D>& facet, const Vec<D - 1>& xi) {
  const auto& patch = at(geometry.patches, facet.patch);
  return geometry.map(patch.project(blended(geometry, facet, xi).X).X).x;
}

template <int D>
void deform(SurfacePoints<D>& points, const SmoothMap<D>& map) {
  for (Index q = 0; q < points.size(); ++q) {
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
  }
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
