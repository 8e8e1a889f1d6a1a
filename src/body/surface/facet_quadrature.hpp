// SPDX-License-Identifier: BSD-3-Clause
// Gauss points of boundary facets.
#pragma once
#include "body/grid/gauss.hpp"
#include "body/surface/reference_surface.hpp"
#include "numbers/dense.hpp"
#include "parallel/parallel.hpp"

namespace meniscus {

/// The normal whose length is the area spanned by the tangents; outward for facets of a boundary.
template <int D>
Vec<D> area_normal(const Eigen::Matrix<Real, D, D - 1>& tangents) {
  if constexpr (D == 3)
    return cross(tangents.col(0), tangents.col(1));
  else
    return Vec<2>(tangents(1, 0), -tangents(0, 0));
}

/// A point of a surface, with the quantities of SurfacePoints.
template <int D>
struct FacetPoint {
  Vec<D> X, N;
  Mat<D> grad_N;
  Real area;
};

template <int D>
using FacetCorners = std::array<Vec<D>, (1 << (D - 1))>;

template <int D>
FacetCorners<D> facet_corners(const Facet<D>& facet, const std::vector<Vec<D>>& X) {
  FacetCorners<D> corners;
  for (std::size_t a = 0; a < corners.size(); ++a) corners[a] = at(X, facet.nodes[a]);
  return corners;
}

/// The points f(facet, xi, weight) at k Gauss points per direction of every facet with
/// wanted(facet). `f` is called on all threads.
template <int D, class Wanted, class F>
SurfacePoints<D> points_of_facets(const Grid<D>& grid, int k, Wanted&& wanted, F&& f) {
  const TensorRule<D - 1> rule = tensor_rule<D - 1>(k);
  SurfacePoints<D> points;
  points.per_facet = static_cast<int>(rule.x.size());
  for (std::size_t i = 0; i < grid.facets.size(); ++i)
    if (wanted(grid.facets[i]))
      points.facet.insert(points.facet.end(), rule.x.size(), static_cast<Index>(i));
  points.X.resize(points.facet.size());
  points.N.resize(points.facet.size());
  points.grad_N.resize(points.facet.size());
  points.area.resize(points.facet.size());
  parallel_for(static_cast<Index>(points.facet.size()), [&](Index p) {
    const auto q = static_cast<std::size_t>(p % points.per_facet);
    const FacetPoint<D> point = f(at(grid.facets, at(points.facet, p)), rule.x[q], rule.w[q]);
    at(points.X, p) = point.X;
    at(points.N, p) = point.N;
    at(points.grad_N, p) = point.grad_N;
    at(points.area, p) = point.area;
  });
  return points;
}

}  // namespace meniscus
