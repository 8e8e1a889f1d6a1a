// SPDX-License-Identifier: BSD-3-Clause
// Surfaces recovered from facets against the exact surfaces of the same grids.
#include "body/surface/recovered_surface.hpp"
#include "body/surface/surface_points.hpp"
#include "meniscus/error.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace meniscus::test_recovered_surface {
namespace {

template <int D>
Geometry<D> ellipsoid(int core) {
  if constexpr (D == 3) {
    Ellipsoid shape;
    shape.semi_axes = {1.3, 1, 0.8};
    shape.core = core;
    shape.layers = core / 2;
    return shape.geometry();
  } else {
    Ellipse shape;
    shape.semi_axes = {1.3, 0.8};
    shape.core = core;
    shape.rings = core / 2;
    return shape.geometry();
  }
}

/// Root mean square errors of positions, normals and curvatures, and the error of the area.
struct Errors {
  Real place = 0, normal = 0, curvature = 0, area = 0;
};

template <int D>
Errors errors(int core) {
  const Geometry<D> exact = ellipsoid<D>(core);
  const Geometry<D> recovered = recovered_geometry<D>(exact.grid);
  const auto a = surface_points(exact, 3), b = surface_points(recovered, 3);
  Errors e;
  Real total = 0, other = 0;
  for (Index q = 0; q < a.size(); ++q) {
    const Real w = at(a.area, q);
    total += w;
    other += at(b.area, q);
    // Only distances along the normal count, since points may be shifted along the surface.
    e.place += w * std::pow(at(a.N, q).dot(at(a.X, q) - at(b.X, q)), 2);
    e.normal += w * (at(a.N, q) - at(b.N, q)).squaredNorm();
    e.curvature += w * std::pow(at(a.grad_N, q).trace() - at(b.grad_N, q).trace(), 2);
    EXPECT_LT((at(b.grad_N, q) * at(b.N, q)).norm(), 1e-12);
  }
  return {std::sqrt(e.place / total), std::sqrt(e.normal / total), std::sqrt(e.curvature / total),
          std::abs(other / total - 1)};
}

/// The order of an error between a grid and one of half its spacing, printed.
Real order(const std::string& of, Real coarse, Real fine) {
  const Real p = std::log2(coarse / fine);
  fmt::print("recovered ellipsoid, {}: {:.2e}, {:.2e}, order {:.2f}\n", of, coarse, fine, p);
  return p;
}

template <int D>
void expect_convergence(int core, Real place, Real normal, Real curvature, Real area) {
  const Errors coarse = errors<D>(core), fine = errors<D>(2 * core);
  EXPECT_GT(order(fmt::format("{}D, places", D), coarse.place, fine.place), place);
  EXPECT_GT(order(fmt::format("{}D, normals", D), coarse.normal, fine.normal), normal);
  EXPECT_GT(order(fmt::format("{}D, curvature", D), coarse.curvature, fine.curvature), curvature);
  EXPECT_GT(order(fmt::format("{}D, area", D), coarse.area, fine.area), area);
  EXPECT_LT(fine.place, 1e-3);
  EXPECT_LT(fine.curvature, 0.2);
}

TEST(RecoveredSurface, ConvergesToTheExactOne) {
  expect_convergence<2>(12, 2.9, 1.9, 0.9, 2.9);
  expect_convergence<3>(6, 2.9, 1.9, 0.9, 2.9);
}

TEST(RecoveredSurface, PassesThroughItsNodesWithoutGaps) {
  const Geometry<3> body = recovered_geometry<3>(ellipsoid<3>(4).grid);
  std::map<std::pair<Index, Index>, Vec<3>> middles;
  for (const auto& facet : body.grid.facets)
    for (int edge = 0; edge < 4; ++edge) {
      const int across = edge / 2, along = 1 - across, corner = (edge % 2) << across;
      Vec<2> xi = Vec<2>::Zero();
      xi[across] = edge % 2 ? 1 : -1;
      const Index a = at(facet.nodes, corner), b = at(facet.nodes, corner | (1 << along));
      const Vec<3> middle = surface_point(body, facet, xi);
      const auto [place, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, middle);
      EXPECT_LT((place->second - middle).norm(), 1e-14);
      xi[along] = -1;
      EXPECT_LT((surface_point(body, facet, xi) - at(body.grid.X, a)).norm(), 1e-14);
    }
}

TEST(RecoveredSurface, FollowsTheNumbersOfTheNodes) {
  Geometry<3> body = recovered_geometry<3>(ellipsoid<3>(4).grid);
  const auto area = [](const Geometry<3>& geometry) {
    const auto points = surface_points(geometry, 2);
    return std::accumulate(points.area.begin(), points.area.end(), 0.0);
  };
  const Real before = area(body);
  order_spatially(body);
  EXPECT_NEAR(area(body), before, 1e-13 * before);
}

TEST(RecoveredSurface, KnowsInnerFromOuter) {
  DiskShell shell;
  shell.radius = 2;
  shell.height = 1.6;
  shell.thickness = 0.4;
  shell.spacing = 0.3;
  const Geometry<3> exact = shell.geometry(), body = recovered_geometry<3>(exact.grid);
  EXPECT_TRUE(body.surface->hollow());
  EXPECT_FALSE(recovered_geometry<3>(ellipsoid<3>(4).grid).surface->hollow());
  for (const SurfacePart part : {SurfacePart::inner, SurfacePart::outer}) {
    const auto a = surface_points(exact, 1, part), b = surface_points(body, 1, part);
    EXPECT_EQ(a.facet, b.facet);
  }
}

TEST(RecoveredSurface, RefusesEdges) {
  EXPECT_THROW_WITH(recovered_geometry<3>(test::brick<3>({2, 2, 2}).grid), InputError,
                    "an edge or corner at node");
  EXPECT_THROW_WITH(recovered_geometry<2>(test::brick<2>({2, 2}).grid), InputError,
                    "an edge or corner at node");
}

}  // namespace
}  // namespace meniscus::test_recovered_surface
