// SPDX-License-Identifier: BSD-3-Clause
// Order, limit and error bar of series with a known limit; finer cells of every shape.
#include "meniscus/body/shapes.hpp"
#include "meniscus/error.hpp"
#include "numbers/convergence.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace meniscus::test_convergence {
namespace {

TEST(Convergence, FindsOrderAndLimitOfPowers) {
  for (const Real p : {0.7, 1.0, 2.0, 3.3})
    for (const Real C : {-3.0, 0.4}) {
      const std::vector<Real> h{0.3, 0.21, 0.11, 0.08};
      std::vector<Real> value;
      for (const Real x : h) value.push_back(7 + C * std::pow(x, p));
      const Convergence found = convergence_of(h, value);
      ASSERT_TRUE(found.order);
      EXPECT_NEAR(*found.order, p, 1e-9);
      EXPECT_NEAR(found.limit, 7, 1e-11);
      EXPECT_GE(found.error_bar, std::abs(value.back() - 7)) << "order " << p;
      EXPECT_GE(found.error_of(value.front()), std::abs(value.front() - 7)) << "order " << p;
      if (p <= 2) {
        EXPECT_NEAR(found.error_bar, 1.25 * std::abs(value.back() - 7), 1e-11);
      }
    }
}

TEST(Convergence, IsCarefulWithoutAnOrder) {
  const std::vector<Real> h{0.4, 0.2, 0.1};
  const Real slow = 1.25 / (std::sqrt(2.0) - 1);  // of one step at order 1/2
  const std::vector<std::pair<std::vector<Real>, Real>> cases{
      {{1, 1.4, 1.1}, 1.5 * 0.4}, {{1, 1.1, 1.6}, 0.5 * slow}, {{1, 1.5, 1.9}, 1.5 * 0.9}};
  for (const auto& [value, bar] : cases) {
    const Convergence found = convergence_of(h, value);
    EXPECT_FALSE(found.order);
    EXPECT_EQ(found.limit, value.back());
    EXPECT_DOUBLE_EQ(found.error_bar, bar);
    EXPECT_DOUBLE_EQ(found.error_of(1), value.back() - 1 + bar);
  }
  const Convergence chance = convergence_of(h, {1, 1.99, 2});  // order 6.6
  EXPECT_GT(chance.order.value(), 6);
  EXPECT_DOUBLE_EQ(chance.error_bar, 1.5);
  const Convergence same = convergence_of(h, {2, 2, 2});
  EXPECT_FALSE(same.order);
  EXPECT_EQ(same.error_bar, 0);
  EXPECT_EQ(same.limit, 2);
  const Convergence wrong = convergence_of(h, {1, NAN, 2});
  EXPECT_FALSE(wrong.order);
  EXPECT_TRUE(std::isnan(wrong.error_bar));
}

/// The grid of a shape whose scene has [resolution].
template <int D>
Grid<D> grid_of(const std::string& shape, const std::string& lines, Real k = 1) {
  const SceneInput input = SceneInput::from_text(
      fmt::format("resolution.refine = {}\n[[body]]\nshape = \"{}\"\n{}", k, shape, lines));
  auto geometry = read_geometry<D>(input.root().tables("body").front());
  input.check();
  return std::move(geometry.grid);
}
template <int D>
Index nodes(const std::string& shape, const std::string& lines, Real k) {
  return grid_of<D>(shape, lines, k).node_count();
}

template <int D>
void expect_finer() {
  for (const auto& [name, entry] : shapes<D>()) {
    if (name == "mesh") continue;
    const std::string lines(entry.example);
    const Real once = nodes<D>(name, lines, 1), twice = nodes<D>(name, lines, 2),
               four = nodes<D>(name, lines, 4);
    EXPECT_GT(twice, 1.6 * once) << name;
    EXPECT_NEAR(std::log2(four / twice), D, 0.45) << name;
  }
}

TEST(Convergence, EveryShapeIsRefinedByOneNumber) {
  expect_finer<2>();
  expect_finer<3>();
  EXPECT_EQ(nodes<2>("disk", "radius = 1\ncore = 4\nrings = 3\n", 1.5),
            nodes<2>("disk", "radius = 1\ncore = 6\nrings = 5\n", 1));
  EXPECT_EQ(nodes<2>("ring", "radius = 1\nthickness = 0.2\naround = 40\nlayers = 4\n", 2.25),
            nodes<2>("ring", "radius = 1\nthickness = 0.2\naround = 92\nlayers = 10\n", 1));
  EXPECT_EQ(nodes<3>("half_sphere", "radius = 1\ncore = 4\nlayers = 2\n", 1.3),
            nodes<3>("half_sphere", "radius = 1\ncore = 6\nlayers = 2\n", 1));
  EXPECT_EQ(nodes<3>("box", "size = [1, 2, 3]\nspacing = 0.5\n", 2),
            nodes<3>("box", "size = [1, 2, 3]\ncells = [4, 8, 12]\n", 1));
}

/// The mean size of the cells over the key spacing.
template <int D>
Real size_of_cells(const std::string& shape, const std::string& lines, Real spacing) {
  const Grid<D> grid = grid_of<D>(shape, fmt::format("{}\nspacing = {}\n", lines, spacing));
  return std::pow(volume(grid) / static_cast<Real>(grid.cell_count()), 1.0 / D) / spacing;
}

/// Numbers of cells are whole, and some even, so that sizes of cells are near the spacing only.
TEST(Convergence, SpacingIsTheSizeOfTheCellsOfRoundShapes) {
  for (const Real spacing : {0.125, 0.09}) {
    for (const auto& [shape, lines] : std::vector<std::pair<std::string, std::string>>{
             {"disk", "radius = 1"},
             {"ellipse", "semi_axes = [1, 1.5]"},
             {"half_disk", "radius = 1"},
             {"cap", "radius = 1\ncontact_angle = 40"},
             {"red_cell", "diameter = 6"},
             {"ring", "radius = 1.5\nthickness = 0.75"}})
      EXPECT_NEAR(size_of_cells<2>(shape, lines, spacing), 1, 0.1) << shape << " " << spacing;
    for (const auto& [shape, lines] :
         std::vector<std::pair<std::string, std::string>>{{"ball", "radius = 1"},
                                                          {"ellipsoid", "semi_axes = [1, 1, 1.5]"},
                                                          {"half_sphere", "radius = 1"},
                                                          {"octant", "radius = 1"},
                                                          {"cap", "radius = 1\ncontact_angle = 40"},
                                                          {"red_cell", "volume = 5"},
                                                          {"cylinder", "radius = 1\nheight = 1"}})
      EXPECT_NEAR(size_of_cells<3>(shape, lines, spacing), 1, 0.1) << shape << " " << spacing;
  }
  const std::string ball = "radius = 1\n";
  EXPECT_EQ(nodes<3>("ball", ball + "spacing = 0.25\n", 1),
            nodes<3>("ball", ball + "core = 4\nlayers = 2\n", 1));
  EXPECT_EQ(nodes<3>("ball", ball + "spacing = 0.25\n", 2),
            nodes<3>("ball", ball + "spacing = 0.125\n", 1));
  EXPECT_EQ(nodes<3>("ball", ball + "spacing = 9\n", 1),
            nodes<3>("ball", ball + "core = 2\nlayers = 1\n", 1));
  EXPECT_THROW(nodes<3>("ball", ball + "spacing = 0.25\nlayers = 2\n", 1), InputError);
  EXPECT_THROW(nodes<2>("ring", ball + "thickness = 0.5\nspacing = 0.1\naround = 20\n", 1),
               InputError);
  EXPECT_THROW(nodes<2>("disk", ball + "spacing = 1e-9\n", 1), InputError);
}

}  // namespace
}  // namespace meniscus::test_convergence
