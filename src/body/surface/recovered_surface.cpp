// SPDX-License-Identifier: BSD-3-Clause
// Surfaces fitted through the boundary nodes of a grid.
#include "body/surface/recovered_surface.hpp"

#include "body/surface/facet_quadrature.hpp"
#include "meniscus/error.hpp"
#include "numbers/dense.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace meniscus {
namespace {

/// Number of corners of a facet: a triangle is stored as a b c c.
template <int D>
std::size_t corner_count(const Facet<D>& facet) {
  if constexpr (D == 3)
    return facet.nodes[2] == facet.nodes[3] ? 3 : 4;
  else
    return 2;
}

/// Coordinates xi of a corner of a facet.
template <int D>
Vec<D - 1> corner_place(std::size_t corner) {
  Vec<D - 1> xi;
  for (int k = 0; k < D - 1; ++k) xi[k] = corner_sign(static_cast<int>(corner), k);
  return xi;
}

template <int D>
Vec<D> normal_at_corner(const Facet<D>& facet, const FacetCorners<D>& corners, std::size_t a) {
  if constexpr (D == 3)
    if (corner_count(facet) == 3)
      return 0.25 * cross(corners[1] - corners[0], corners[2] - corners[0]);
  return area_normal<D>(multilinear<D, D - 1>(corners, corner_place<D>(a)).J);
}

template <int D>
struct BoundaryNodes {
  std::vector<Index> node;    ///< number of each boundary node in the grid
  std::vector<Index> number;  ///< [grid node] number among boundary nodes; -1: inside the body
  std::vector<std::set<Index>> beside;  ///< boundary nodes that share a facet
  std::vector<Vec<D>> normal;           ///< mean normal of its facets, weighted by area
};

template <int D>
BoundaryNodes<D> boundary_of(const Grid<D>& grid) {
  BoundaryNodes<D> b;
  b.node = boundary_nodes(grid);
  b.number.assign(grid.X.size(), -1);
  for (std::size_t i = 0; i < b.node.size(); ++i) at(b.number, b.node[i]) = static_cast<Index>(i);
  b.beside.resize(b.node.size());
  b.normal.assign(b.node.size(), Vec<D>::Zero());
  for (const Facet<D>& facet : grid.facets) {
    const FacetCorners<D> corners = facet_corners(facet, grid.X);
    for (std::size_t a = 0; a < corner_count(facet); ++a) {
      const Index i = at(b.number, facet.nodes[a]);
      for (const Index other : facet.nodes)
        if (other != facet.nodes[a]) at(b.beside, i).insert(at(b.number, other));
      at(b.normal, i) += normal_at_corner(facet, corners, a);
    }
  }
  for (Vec<D>& n : b.normal) n.normalize();
  return b;
}

/// A node at which the surface has an edge or corner; -1 if there is none.
template <int D>
Index find_edge(const Grid<D>& grid, const BoundaryNodes<D>& b) {
  constexpr Real least_cosine = 0.75;  // cosine of 41 degrees
  for (const Facet<D>& facet : grid.facets) {
    const FacetCorners<D> corners = facet_corners(facet, grid.X);
    for (std::size_t a = 0; a < corner_count(facet); ++a) {
      const Vec<D> normal = normal_at_corner(facet, corners, a);
      if (normal.normalized().dot(at(b.normal, at(b.number, facet.nodes[a]))) < least_cosine)
        return facet.nodes[a];
    }
  }
  return -1;
}

/// [boundary node] 1 if it is on a closed part of the surface that bounds a cavity.
template <int D>
std::vector<char> inner_nodes(const Grid<D>& grid, const BoundaryNodes<D>& b) {
  std::vector<Index> part(b.node.size());  // smallest boundary node of its part, by flooding
  std::iota(part.begin(), part.end(), 0);
  std::vector<Index> open;
  std::vector<char> seen(b.node.size(), 0);
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (seen[i]) continue;
    open.assign(1, static_cast<Index>(i));
    seen[i] = 1;
    while (!open.empty()) {
      const Index k = open.back();
      open.pop_back();
      at(part, k) = static_cast<Index>(i);
      for (const Index other : at(b.beside, k))
        if (!at(seen, other)) {
          at(seen, other) = 1;
          open.push_back(other);
        }
    }
  }
  std::vector<Real> volume(b.node.size(), 0.0);  // D times the volume within a part, signed
  for (const Facet<D>& facet : grid.facets) {
    const auto p = multilinear<D, D - 1>(facet_corners(facet, grid.X), Vec<D - 1>::Zero());
    const Index k = at(part, at(b.number, facet.nodes[0]));
    at(volume, k) += (p.X - at(grid.X, at(b.node, k))).dot(area_normal<D>(p.J));
  }
  std::vector<char> inner;
  for (const Index k : part) inner.push_back(at(volume, k) < 0);
  return inner;
}

/// Boundary nodes within two rings of facets, without the node itself.
std::set<Index> two_rings(const std::vector<std::set<Index>>& beside, Index i) {
  std::set<Index> near = at(beside, i);
  for (const Index k : at(beside, i)) near.insert(at(beside, k).begin(), at(beside, k).end());
  near.erase(i);
  return near;
}

/// Slope and bend (upper triangle) of the best fit of a quadratic height.
template <int D>
Eigen::VectorXd fitted(const Grid<D>& grid, const BoundaryNodes<D>& b, Index i,
                       const Eigen::Matrix<Real, D, D - 1>& t, Real least_curvature) {
  constexpr int unknowns = D - 1 + D * (D - 1) / 2;
  const Vec<D>& X = at(grid.X, at(b.node, i));
  const std::set<Index> near = two_rings(b.beside, i);
  Real reach = 0;
  for (const Index k : near) reach = std::max(reach, (at(grid.X, at(b.node, k)) - X).norm());
  reach *= 1.2;
  Eigen::Matrix<Real, unknowns, unknowns> M = Eigen::Matrix<Real, unknowns, unknowns>::Zero();
  Eigen::Matrix<Real, unknowns, 1> right = Eigen::Matrix<Real, unknowns, 1>::Zero();
  for (const Index k : near) {
    const Vec<D> r = (at(grid.X, at(b.node, k)) - X) / reach;
    const Vec<D - 1> s = t.transpose() * r;
    Eigen::Matrix<Real, unknowns, 1> p;
    int row = 0;
    for (int c = 0; c < D - 1; ++c) p[row++] = s[c];
    for (int c = 0; c < D - 1; ++c)
      for (int d = c; d < D - 1; ++d) p[row++] = c == d ? s[c] * s[c] / 2 : s[c] * s[d];
    const Real weight = std::pow(1 - r.norm(), 2);
    M += weight * p * p.transpose();
    right += weight * at(b.normal, i).dot(r) * p;
  }
  if (least_curvature > 0) M.diagonal().array() += least_curvature * M.trace();
  Eigen::VectorXd height = solve_symmetric(M, right);
  height.tail(unknowns - (D - 1)) /= reach;  // lengths were in units of the reach
  return height;
}

}  // namespace

/// A point of a facet, with its tangents and the gradient of the normal.
template <int D>
struct RecoveredSurface<D>::Place {
  Vec<D> X = Vec<D>::Zero();
  Eigen::Matrix<Real, D, D - 1> J = Eigen::Matrix<Real, D, D - 1>::Zero();
  Mat<D> grad_N = Mat<D>::Zero();
};

template <int D>
RecoveredSurface<D>::RecoveredSurface(const Grid<D>& grid) {
  if (const Index node = find_edge(grid, boundary_of(grid)); node >= 0)
    throw InputError(
        fmt::format("the surface has an edge or corner at node {}; a surface can be "
                    "recovered from facets where it is smooth only",
                    node));
  recover(grid, 0);
}

template <int D>
std::shared_ptr<const RecoveredSurface<D>> RecoveredSurface<D>::if_smooth(const Grid<D>& grid) {
  if (find_edge(grid, boundary_of(grid)) >= 0) return nullptr;
  return std::make_shared<const RecoveredSurface>(grid);
}

template <int D>
std::shared_ptr<const RecoveredSurface<D>> RecoveredSurface<D>::of_piece(const Grid<D>& grid) {
  auto surface = std::shared_ptr<RecoveredSurface>(new RecoveredSurface);
  surface->recover(grid, 1e-10);  // if nodes are few, take the fit with least curvature
  return surface;
}

template <int D>
void RecoveredSurface<D>::recover(const Grid<D>& grid, Real least_curvature) {
  const BoundaryNodes<D> b = boundary_of(grid);
  const std::vector<char> inner = inner_nodes(grid, b);
  number_ = b.number;
  for (std::size_t i = 0; i < b.node.size(); ++i) {
    Quadric q;
    q.X = at(grid.X, b.node[i]);
    q.n = b.normal[i];
    q.t = tangents_to<D>(q.n);
    const Eigen::VectorXd height = fitted<D>(grid, b, static_cast<Index>(i), q.t, least_curvature);
    q.slope = height.head<D - 1>();
    Eigen::Index row = D - 1;
    for (int c = 0; c < D - 1; ++c)
      for (int d = c; d < D - 1; ++d) q.bend(c, d) = q.bend(d, c) = height[row++];
    q.inner = inner[i] != 0;
    quadrics_.push_back(q);
  }
}

template <int D>
typename RecoveredSurface<D>::Place RecoveredSurface<D>::blended(const Grid<D>& grid,
                                                                 const Facet<D>& facet,
                                                                 const Vec<D - 1>& xi) const {
  const auto flat = multilinear<D, D - 1>(facet_corners(facet, grid.X), xi);
  Place place;
  for (std::size_t a = 0; a < facet.nodes.size(); ++a) {
    const Quadric& q = around(facet.nodes[a]);
    const Vec<D - 1> s = q.t.transpose() * (flat.X - q.X), rise = q.slope + q.bend * s;
    const Vec<D> X = q.X + q.t * s + q.n * (q.slope.dot(s) + 0.5 * s.dot(q.bend * s));
    const Mat<D> derivative = (q.t + q.n * rise.transpose()) * q.t.transpose();
    Real N = 1;
    Vec<D - 1> dN = Vec<D - 1>::Ones();
    for (int k = 0; k < D - 1; ++k) {
      const Real sign = corner_sign(static_cast<int>(a), k), value = 0.5 * (1 + sign * xi[k]);
      N *= value;
      for (int l = 0; l < D - 1; ++l) dN[l] *= l == k ? 0.5 * sign : value;
    }
    place.X += N * X;
    place.J += X * dN.transpose() + N * derivative * flat.J;
    place.grad_N -= N / (q.n - q.t * rise).norm() * q.t * q.bend * q.t.transpose();
  }
  return place;
}

template <int D>
SurfacePoints<D> RecoveredSurface<D>::points(const Grid<D>& grid, int k, SurfacePart part) const {
  const auto wanted = [&](const Facet<D>& facet) {
    return part == SurfacePart::whole ||
           around(facet.nodes[0]).inner == (part == SurfacePart::inner);
  };
  const auto at_place = [&](const Facet<D>& facet, const Vec<D - 1>& xi, Real w) {
    const Place place = blended(grid, facet, xi);
    const Vec<D> normal = area_normal<D>(place.J), N = normal.normalized();
    const Mat<D> along = Mat<D>::Identity() - N * N.transpose();
    return FacetPoint<D>{place.X, N, along * place.grad_N * along, w * normal.norm()};
  };
  SurfacePoints<D> points = points_of_facets(grid, k, wanted, at_place);
  points.exact = true;
  return points;
}

template <int D>
Vec<D> RecoveredSurface<D>::point(const Grid<D>& grid, const Facet<D>& facet,
                                  const Vec<D - 1>& xi) const {
  return blended(grid, facet, xi).X;
}

template <int D>
bool RecoveredSurface<D>::hollow() const {
  return std::any_of(quadrics_.begin(), quadrics_.end(), [](const Quadric& q) { return q.inner; });
}

template <int D>
std::shared_ptr<const Surface<D>> RecoveredSurface<D>::renumbered(
    std::span<const Index> order) const {
  auto surface = std::shared_ptr<RecoveredSurface>(new RecoveredSurface);
  surface->quadrics_ = quadrics_;
  for (const Index i : order) surface->number_.push_back(at(number_, i));
  return surface;
}

template <int D>
std::shared_ptr<const Surface<D>> RecoveredSurface<D>::mapped(const SmoothMap<D>&,
                                                              const Grid<D>& grid) const {
  return std::make_shared<RecoveredSurface>(grid);
}

template <int D>
Geometry<D> recovered_geometry(Grid<D> grid) {
  find_boundary(grid);
  auto surface = std::make_shared<RecoveredSurface<D>>(grid);
  Geometry<D> geometry{std::move(grid), std::move(surface)};
  curve_boundary(geometry);
  check_jacobians(geometry.grid, "the surface");
  return geometry;
}

#define MENISCUS_INSTANTIATE(D)       \
  template class RecoveredSurface<D>; \
  template Geometry<D> recovered_geometry(Grid<D>);
MENISCUS_INSTANTIATE(2)
MENISCUS_INSTANTIATE(3)
#undef MENISCUS_INSTANTIATE

}  // namespace meniscus
