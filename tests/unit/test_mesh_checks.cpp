// SPDX-License-Identifier: BSD-3-Clause
// Refuses meshes whose cells overlap or do not form one body. Facets whose curvature would fold a
// cell stay straight.
#include "body/grid/curved_facets.hpp"
#include "body/surface/surface_points.hpp"
#include "meniscus/error.hpp"
#include "mesh_support.hpp"
#include "numbers/box.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace meniscus::test_mesh_checks {
namespace {

using std::numbers::pi;

template <int D>
std::string problem_of(const Grid<D>& grid, const test::CellList& cells) {
  try {
    test::geometry_of_file<D>(test::written("checked.msh", test::msh_of<D>(grid, cells)));
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

/// Unit cells in [0, n]^D.
template <int D>
Grid<D> block(int n) {
  Grid<D> grid = test::brick<D>(std::vector<Real>(D, n)).grid;
  const Vec<D> low = box_around<D>(grid.X).low;
  for (Vec<D>& X : grid.X) X -= low;
  return grid;
}

void expect_words(const std::string& found, const std::string& words) {
  EXPECT_NE(found.find(words), found.npos) << found << "\nshould say: " << words;
  EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), 0) << found;
}

/// An additional tetrahedron, made of new or existing nodes, overlaps with the block.
TEST(MeshChecks, OverlappingCellsAreRefused) {
  Grid<3> grid = block<3>(2);
  const test::CellList cells = test::simplices_of(grid);
  const auto with = [&](const std::vector<Vec<3>>& places, std::vector<Index> nodes) {
    Grid<3> other = grid;
    test::CellList more = cells;
    for (const Vec<3>& X : places) {
      nodes.push_back(other.node_count());
      other.X.push_back(X);
    }
    more.push_back(nodes);
    return problem_of<3>(other, more);
  };
  EXPECT_EQ(problem_of<3>(grid, cells), "none");
  // A separate tetrahedron inside a cell.
  const auto tetrahedron = [](const Vec<3>& x, Real size) {
    return std::vector<Vec<3>>{x, x + size * Vec<3>::Unit(0), x + size * Vec<3>::Unit(1),
                               x + size * Vec<3>::Unit(2)};
  };
  expect_words(with(tetrahedron({0.11, 0.12, 0.13}, 0.05), {}), "cells overlap");
  // Separate tetrahedra with corners outside: one around a corner of the block, one through the
  // block.
  expect_words(with(tetrahedron({-0.5, -0.5, -0.5}, 9), {}), "overlap");
  expect_words(with({{0.3, 0.4, -3}, {0.35, 0.41, -3}, {0.31, 0.45, -3}, {0.3, 0.4, 3}}, {}),
               "the surface goes through itself");
  // A tetrahedron on a surface facet that points inwards; and a copy of a cell.
  Grid<3> one = block<3>(1);
  const test::CellList of_one = test::simplices_of(one);
  test::CellList twice = of_one;
  twice.push_back(of_one.front());
  expect_words(problem_of<3>(one, twice), "overlap");
  find_boundary(one);
  const auto& facet = one.facets.front().nodes;
  one.X.push_back({0.5, 0.45, 0.4});
  test::CellList inward = of_one;
  for (const auto& cell : of_one) {  // a facet of a tetrahedron that lies in one of the block
    int on = 0;
    for (const Index n : cell) on += std::count(facet.begin(), facet.end(), n) > 0;
    if (on < 3) continue;
    std::vector<Index> nodes;
    for (const Index n : cell)
      if (std::count(facet.begin(), facet.end(), n) > 0) nodes.push_back(n);
    nodes.push_back(one.node_count() - 1);
    inward.push_back(nodes);
    break;
  }
  expect_words(problem_of<3>(one, inward), "overlap");
}

TEST(MeshChecks, OverlappingQuadrilateralsAreRefused) {
  Grid<2> grid = block<2>(3);
  test::CellList cells = test::cells_of(grid);
  for (const Vec<2>& X : {Vec<2>(2.9, 1.2), {5, 1.2}, {5, 1.4}, {2.9, 1.4}}) grid.X.push_back(X);
  const Index n = grid.node_count();
  cells.push_back({n - 4, n - 3, n - 2, n - 1});
  expect_words(problem_of<2>(grid, cells), "cells overlap");
  for (Index k = 1; k <= 4; ++k) at(grid.X, n - k)[0] += k == 2 || k == 3 ? 4 : -4;
  expect_words(problem_of<2>(grid, cells), "the surface goes through itself");
}

/// Two blocks that share only an edge or a corner are refused.
TEST(MeshChecks, PartsThatMeetInAnEdgeOrACornerAreRefused) {
  for (const bool corner : {false, true}) {
    Grid<3> grid = block<3>(2);
    const auto keep = [&](const std::vector<Index>& cell) {
      Vec<3> middle = Vec<3>::Zero();
      for (const Index n : cell) middle += at(grid.X, n) / Real(cell.size());
      const bool low = middle[0] < 1 && middle[1] < 1 && middle[2]<1, high = middle[0]> 1 &&
                       middle[1] > 1 && (!corner || middle[2] > 1);
      return low || high;
    };
    for (const bool simplices : {false, true}) {
      test::CellList cells = simplices ? test::simplices_of(grid) : test::cells_of(grid);
      std::erase_if(cells, [&](const auto& cell) { return !keep(cell); });
      expect_words(problem_of<3>(grid, cells),
                   "parts of the body meet in an edge or a corner only");
    }
  }
  Grid<2> grid = block<2>(2);
  test::CellList cells = test::cells_of(grid);
  cells = {cells[0], cells[3]};
  expect_words(problem_of<2>(grid, cells), "parts of the body meet in a corner only");
}

/// Separate parts are refused, because kernels would reach across the gap between them.
TEST(MeshChecks, PartsApartAreRefused) {
  Grid<2> grid = block<2>(3);
  test::CellList cells = test::cells_of(grid);
  std::erase_if(cells, [&](const auto& cell) {
    const Real x = at(grid.X, cell[0])[0] + at(grid.X, cell[2])[0];
    return x > 2 && x < 4;
  });
  EXPECT_EQ(cells.size(), 6u);
  const std::string found = problem_of<2>(grid, cells);
  expect_words(found, "the cells are 2 parts that do not touch each other, with line ");
  expect_words(found, ": element 1 at (0.5, 0.5), line ");
  expect_words(found, "at (2.5, 0.5); expected is one part: give each part a file and a [[body]]");
  test::CellList apart;
  Grid<3> many = block<3>(1);
  for (Index k = 0; k < 6; ++k) {
    std::vector<Index>& cell = apart.emplace_back(test::cells_of(block<3>(1)).front());
    for (Index& node : cell) node += 8 * k;
    if (k > 0)
      for (Index n = 0; n < 8; ++n)
        many.X.push_back(at(many.X, n) + 2 * static_cast<Real>(k) * Vec<3>::Unit(2));
  }
  expect_words(problem_of<3>(many, apart), "the cells are 6 parts");
  expect_words(problem_of<3>(many, apart), "at (0.5, 0.5, 6.5), ...; expected is one part");
}

/// A square with rounded corners. Each corner is an arc of radius 0.02 with two facets, which
/// belong to the same cell. Each side has two facets.
std::string rounded_square() {
  std::vector<Vec<2>> X;
  const Real r = 0.02;
  const std::vector<Vec<2>> middles{{1 - r, 1 - r}, {r, 1 - r}, {r, r}, {1 - r, r}};
  const std::vector<Vec<2>> sides{{0.5, 1}, {0, 0.5}, {0.5, 0}, {1, 0.5}};
  for (std::size_t k = 0; k < 4; ++k) {
    for (int part = 0; part < 3; ++part) {
      const Real angle = (static_cast<Real>(k) + 0.5 * part) * pi / 2;
      X.push_back(middles[k] + r * Vec<2>(std::cos(angle), std::sin(angle)));
    }
    X.push_back(sides[k]);
  }
  X.push_back({0.5, 0.5});
  std::string text = fmt::format("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", X.size());
  for (std::size_t i = 0; i < X.size(); ++i)
    text += fmt::format("{} {:.17g} {:.17g} 0\n", i + 1, X[i][0], X[i][1]);
  text += "$EndNodes\n$Elements\n16\n";
  for (int k = 1, e = 1; k <= 16; k += 4)
    for (const auto& [a, b, c] : {std::array{k, k + 1, k + 2},
                                  {k, k + 2, 17},
                                  {k + 2, k + 3, 17},
                                  {k + 3, (k + 3) % 16 + 1, 17}})
      text += fmt::format("{} 2 2 0 1 {} {} {}\n", e++, a, b, c);
  return text + "$EndElements\n";
}

TEST(MeshChecks, FacetsThatWouldFoldACellAreStraight) {
  const std::string file = test::written("rounded.msh", rounded_square());
  const Geometry<2> body = test::geometry_of_file<2>(file);
  EXPECT_EQ(curved_facets(body).straightened, 8) << "those of the arcs";
  EXPECT_FALSE(body.grid.bulges.empty()) << "the others";
  const Geometry<2> flat = test::geometry_of_file<2>(file, "facets = 'flat'\n");
  EXPECT_EQ(curved_facets(flat).straightened, 0);
  EXPECT_EQ(curved_facets(flat).added_volume, 0);
  EXPECT_NEAR(curved_facets(body).added_volume, volume(body.grid) / volume(flat.grid) - 1, 1e-14);
  EXPECT_TRUE(flat.grid.bulges.empty());
  EXPECT_NEAR(volume(flat.grid), 1 - 0.02 * 0.02 * (4 - 8 * std::sin(pi / 4) / 2), 1e-12);
  Real length = 0;
  const SurfacePoints<2> points = surface_points(flat, 2);
  for (const Real l : points.area) length += l;
  EXPECT_NEAR(length, 4 * 0.96 + 16 * 0.02 * std::sin(pi / 8), 1e-12);
}

}  // namespace
}  // namespace meniscus::test_mesh_checks
