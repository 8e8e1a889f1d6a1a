// SPDX-License-Identifier: BSD-3-Clause
// Points, normals and curvature of quadratic patches.
#include "body/surface/quadratic_surface.hpp"

#include "body/surface/facet_quadrature.hpp"
#include "numbers/dense.hpp"

#include <algorithm>
#include <numeric>

namespace meniscus {
namespace {

template <int D>
constexpr std::array<Index, PatchFunctions<D>::nodes> own_points() {
  std::array<Index, PatchFunctions<D>::nodes> points{};
  std::iota(points.begin(), points.end(), 0);
  return points;
}

/// Second derivative X_,kl of a patch, whose functions are at most quadratic in each direction.
template <int D>
Vec<D> second_derivative(const std::vector<Vec<D>>& x, const Vec<D - 1>& xi, int k, int l) {
  constexpr std::array<Real, 3> bend = {1, -2, 1};
  const auto slope = [](int i, Real s) { return i == 1 ? -2 * s : s + 0.5 * (i - 1); };
  const auto value = [](int i, Real s) { return i == 1 ? 1 - s * s : 0.5 * s * (s + i - 1); };
  Vec<D> sum = Vec<D>::Zero();
  for (std::size_t a = 0; a < x.size(); ++a) {
    Real L = 1;
    for (int m = 0, rest = static_cast<int>(a); m < D - 1; ++m, rest /= 3)
      L *= m == k && m == l   ? at(bend, rest % 3)
           : m == k || m == l ? slope(rest % 3, xi[m])
                              : value(rest % 3, xi[m]);
    sum += L * x[a];
  }
  return sum;
}

/// Gradient N_K,L of the normal along the surface.
template <int D>
Mat<D> normal_gradient(const std::vector<Vec<D>>& x, const Vec<D - 1>& xi,
                       const Eigen::Matrix<Real, D, D - 1>& J, const Vec<D>& N) {
  Mat<D - 1> b;
  for (int k = 0; k < D - 1; ++k)
    for (int l = 0; l < D - 1; ++l) b(k, l) = N.dot(second_derivative<D>(x, xi, k, l));
  const Eigen::Matrix<Real, D, D - 1> dual = J * inverse<D - 1>(J.transpose() * J);
  return -dual * b * dual.transpose();
}

}  // namespace

template <int D>
QuadraticSurface<D>::QuadraticSurface(const Grid<D>& grid, const std::vector<Vec<D>>& points,
                                      bool smooth, std::vector<char> inner)
    : smooth_(smooth), inner_(std::move(inner)) {
  for (const auto& [key, number] : PatchNodes<D>(grid).number) point_[key] = at(points, number);
}

template <int D>
std::vector<Vec<D>> QuadraticSurface<D>::of(const Facet<D>& facet) const {
  std::vector<Vec<D>> x;
  for (int a = 0; a < PatchFunctions<D>::nodes; ++a)
    x.push_back(point_.at(patch_key(facet, patch_node<D>(a))));
  return x;
}

template <int D>
SurfacePoints<D> QuadraticSurface<D>::points(const Grid<D>& grid, int k, SurfacePart part) const {
  const auto wanted = [&](const Facet<D>& facet) {
    const bool inner = !inner_.empty() && at(inner_, facet.patch);
    return part == SurfacePart::whole || inner == (part == SurfacePart::inner);
  };
  const auto at_place = [&](const Facet<D>& facet, const Vec<D - 1>& xi, Real w) {
    const std::vector<Vec<D>> x = of(facet);
    const auto place = patch_place<D>(PatchFunctions<D>(xi), own_points<D>(), x);
    const Vec<D> normal = area_normal<D>(place.J), N = normal.normalized();
    return FacetPoint<D>{place.X, N, normal_gradient<D>(x, xi, place.J, N), w * normal.norm()};
  };
  SurfacePoints<D> points = points_of_facets(grid, k, wanted, at_place);
  points.exact = true;
  return points;
}

template <int D>
Vec<D> QuadraticSurface<D>::point(const Grid<D>&, const Facet<D>& facet,
                                  const Vec<D - 1>& xi) const {
  return patch_place<D>(PatchFunctions<D>(xi), own_points<D>(), of(facet)).X;
}

template <int D>
bool QuadraticSurface<D>::hollow() const {
  return std::any_of(inner_.begin(), inner_.end(), [](char inner) { return inner != 0; });
}

template <int D>
std::shared_ptr<const Surface<D>> QuadraticSurface<D>::through(std::map<Key, Vec<D>> point) const {
  auto surface = std::shared_ptr<QuadraticSurface>(new QuadraticSurface);
  surface->point_ = std::move(point);
  surface->smooth_ = smooth_;
  surface->inner_ = inner_;
  return surface;
}

template <int D>
std::shared_ptr<const Surface<D>> QuadraticSurface<D>::renumbered(
    std::span<const Index> order) const {
  // `order` may leave out nodes.
  std::vector<Index> number(
      order.empty() ? 0
                    : static_cast<std::size_t>(*std::max_element(order.begin(), order.end())) + 1,
      -1);
  for (std::size_t i = 0; i < order.size(); ++i) at(number, order[i]) = static_cast<Index>(i);
  std::map<Key, Vec<D>> point;
  for (const auto& [old, place] : point_) {
    Key key = old;
    const auto is_left_out = [&](Index node) {
      return node >= static_cast<Index>(number.size()) || at(number, node) < 0;
    };
    if (std::any_of(key.begin(), key.end(), is_left_out)) continue;
    for (Index& node : key) node = at(number, node);
    std::sort(key.begin(), key.end());
    point[key] = place;
  }
  return through(std::move(point));
}

template <int D>
std::shared_ptr<const Surface<D>> QuadraticSurface<D>::mapped(const SmoothMap<D>& map,
                                                              const Grid<D>&) const {
  std::map<Key, Vec<D>> point = point_;
  for (auto& [key, place] : point) place = map(place).x;
  return through(std::move(point));
}

template <int D>
Geometry<D> quadratic_geometry(Grid<D> grid, const std::vector<Vec<D>>& points, bool smooth) {
  find_boundary(grid);
  auto surface = std::make_shared<QuadraticSurface<D>>(grid, points, smooth);
  Geometry<D> geometry{std::move(grid), std::move(surface)};
  curve_boundary(geometry);
  check_jacobians(geometry.grid, "the new reference");
  return geometry;
}

#define MENISCUS_INSTANTIATE(D)       \
  template class QuadraticSurface<D>; \
  template Geometry<D> quadratic_geometry(Grid<D>, const std::vector<Vec<D>>&, bool);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
