// SPDX-License-Identifier: BSD-3-Clause
// Gauss points of boundary facets.
#pragma once
#include "meniscus/body/gauss.hpp"
#include "meniscus/body/surface.hpp"
#include "meniscus/core/dense.hpp"

namespace meniscus {

/// Normal whose length is the area spanned by the tangents; outward for outward facets.
template <int D>
Vec<D> area_normal(const Eigen::Matrix<Real, D, D - 1>& tangents) {
  if constexpr (D == 3)
    return cross(tangents.col(0), tangents.col(1));
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

}  // namespace meniscus
