// SPDX-License-Identifier: BSD-3-Clause
// Meshes of files with all edges halved, by refine = 2, 4, 8: the body stays the same, and cells do
// not become flat.
#include "body/grid/simplex.hpp"
#include "meniscus/error.hpp"
#include "mesh_support.hpp"
#include "numbers/dense.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace meniscus::test_mesh_halving {
namespace {

/// A block with disordered inner nodes.
template <int D>
Grid<D> block(int n) {
  return test::brick<D>(std::vector<Real>(D, n), 0.3).grid;
}

/// Area of each face, of straight facets.
template <int D>
std::map<std::string, Real> areas(const Geometry<D>& body) {
  std::map<std::string, Real> sum;
  for (const Facet<D>& facet : body.grid.facets) {
    const auto X = [&](int a) { return spatial<D>(at(body.grid.X, at(facet.nodes, a))); };
    Real area;
    if constexpr (D == 2)
      area = (X(1) - X(0)).norm();
    else
      area = (cross(X(1) - X(0), X(2) - X(0)).norm() + cross(X(2) - X(3), X(1) - X(3)).norm()) / 2;
    sum[body.surface->face_name(facet.patch)] += area;
  }
  return sum;
}

template <int D>
void expect_same_block(bool simplices) {
  const Grid<D> grid = block<D>(2);
  const Geometry<D> once = test::imported<D>(grid, simplices);
  for (const int k : {2, 4}) {
    const Geometry<D> fine = test::imported<D>(grid, simplices, test::refined_by(k));
    EXPECT_EQ(fine.grid.cells.size(),
              static_cast<std::size_t>(std::pow(k, D)) * once.grid.cells.size());
    EXPECT_NEAR(volume(fine.grid), volume(once.grid), 1e-12);
    const auto coarse_areas = areas(once), fine_areas = areas(fine);
    ASSERT_EQ(fine_areas.size(), 2u * D);
    for (const auto& [name, area] : coarse_areas) EXPECT_NEAR(fine_areas.at(name), area, 1e-12);
  }
}
TEST(MeshHalving, KeepsVolumeAndFaces) {
  for (const bool simplices : {false, true}) {
    expect_same_block<2>(simplices);
    expect_same_block<3>(simplices);
  }
}

/// A surface recovered from the nodes of a ball changes less with each halving.
TEST(MeshHalving, KeepsARoundBody) {
  for (const bool simplices : {false, true}) {
    Grid<3> grid = test::ball(2, 1).grid;
    grid.bulges.clear();
    grid.bulge_of.clear();
    Real v[3];
    for (int level = 0; level < 3; ++level)
      v[level] = volume(test::imported<3>(grid, simplices, test::refined_by(1 << level)).grid);
    EXPECT_LT(std::abs(v[1] / v[0] - 1), 0.02) << simplices;
    EXPECT_LT(std::abs(v[2] - v[1]), 0.3 * std::abs(v[1] - v[0])) << simplices;
  }
}

/// The body between quadratic edges of a file stays the same.
TEST(MeshHalving, KeepsQuadraticPatches) {
  const auto begin = [](int nodes) {
    return fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", nodes);
  };
  const std::string triangle =
      begin(6) +
      "1 0 0 0\n2 2 0 0\n3 0 2 0\n4 1 -0.3 0\n5 1.2 1.2 0\n6 0.1 1 0\n$EndNodes\n"
      "$Elements\n1\n1 9 2 0 1 1 2 3 4 5 6\n$EndElements\n";
  const std::string tetrahedron =
      begin(10) +
      "1 0 0 0\n2 2 0 0\n3 0 2 0\n4 0 0 2\n5 1 0 -0.2\n6 1.1 1.1 0\n7 0 1 0\n8 0 0.1 1\n"
      "9 0 1 1.2\n10 1.1 0 1.1\n$EndNodes\n$Elements\n1\n1 11 2 0 1 1 2 3 4 5 6 7 8 9 10\n"
      "$EndElements\n";
  const std::string flat = test::written("quadratic_2.msh", triangle),
                    solid = test::written("quadratic_3.msh", tetrahedron);
  // The area between a chord c and a parabola of height h is 2/3 c h.
  const Real exact = 2 + 2.0 / 3 * (2 * 0.3 + std::sqrt(8) * 0.2 * std::sqrt(2) - 2 * 0.1);
  for (const int k : {1, 2, 4}) {
    const std::string more = test::refined_by(k);
    EXPECT_NEAR(volume(test::geometry_of_file<2>(flat, more).grid), exact, 1e-12) << k;
  }
  const Real once = volume(test::geometry_of_file<3>(solid).grid);
  for (const int k : {2, 4})
    EXPECT_NEAR(volume(test::geometry_of_file<3>(solid, test::refined_by(k)).grid), once, 1e-12)
        << k;
}

/// Volume of the tetrahedron over that of a regular one with the same mean square of its edges.
Real quality(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& d) {
  const Real squares = (b - a).squaredNorm() + (c - a).squaredNorm() + (d - a).squaredNorm() +
                       (c - b).squaredNorm() + (d - b).squaredNorm() + (d - c).squaredNorm();
  return cross(b - a, c - a).dot(d - a) * std::sqrt(2) / std::pow(squares / 6, 1.5);
}

/// Over three halvings, tetrahedra of any form have positive volumes, and the worst of their parts
/// is not much worse than they are.
TEST(MeshHalving, BoundsTheQualityOfTetrahedra) {
  std::mt19937 random(5);
  std::uniform_real_distribution<Real> place(0, 1);
  for (int made = 0; made < 20;) {
    Grid<3> grid;
    for (int i = 0; i < 4; ++i) grid.X.emplace_back(place(random), place(random), place(random));
    const auto quality_of = [](const Grid<3>& g, const std::array<Index, 8>& cell) {
      const auto X = [&](int i) { return at(g.X, at(cell, at(simplex_corners<3>(), i))); };
      return quality(X(0), X(1), X(2), X(3));
    };
    const Real own = quality(grid.X[0], grid.X[1], grid.X[2], grid.X[3]);
    if (own < 0.1) continue;
    ++made;
    const std::string file = test::written("one.msh", test::msh_of<3>(grid, {{0, 1, 2, 3}}));
    Real before = own;
    for (const int k : {2, 4, 8}) {
      const Geometry<3> fine =
          test::geometry_of_file<3>(file, "facets = 'flat'\n" + test::refined_by(k));
      Real worst = 1;
      for (const auto& cell : fine.grid.cells) worst = std::min(worst, quality_of(fine.grid, cell));
      EXPECT_GT(worst, 0.6 * own) << k;
      if (k > 2) {
        EXPECT_GT(worst, 0.95 * before) << k;
      }
      before = worst;
      EXPECT_NEAR(volume(fine.grid) * 6,
                  cross(grid.X[1] - grid.X[0], grid.X[2] - grid.X[0]).dot(grid.X[3] - grid.X[0]),
                  1e-12);
    }
  }
}

TEST(MeshHalving, OtherFactorsAreRefused) {
  for (const char* k : {"1.5", "3", "0.5"}) {
    try {
      test::imported<2>(block<2>(2), true, fmt::format("[resolution]\nrefine = {}\n", k));
      ADD_FAILURE() << k;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("is a power of 2"), std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace meniscus::test_mesh_halving
