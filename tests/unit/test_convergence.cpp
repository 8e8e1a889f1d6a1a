// SPDX-License-Identifier: BSD-3-Clause
// Order, limit and error bar of series with a known limit; finer cells of every shape.
#include "meniscus/body/shapes.hpp"
#include "numbers/convergence.hpp"
#include "support.hpp"
#include "thrown.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

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
      if (p <= 2) {
        EXPECT_NEAR(found.error_bar, 1.25 * std::abs(value.back() - 7), 1e-11);
      }
    }
}

TEST(Convergence, HasTheSpreadWithoutAnOrder) {
  const std::vector<Real> h{0.3, 0.2, 0.1};
  for (const auto& value : std::vector<std::vector<Real>>{{1, 1.4, 1.1}, {1, 1.1, 1.6}}) {
    const Convergence found = convergence_of(h, value);
    EXPECT_FALSE(found.order);
    EXPECT_EQ(found.limit, value.back());
    EXPECT_DOUBLE_EQ(found.error_bar, value[0] == 1 && value[2] == 1.1 ? 0.4 : 0.6);
  }
  const Convergence same = convergence_of(h, {2, 2, 2});
  EXPECT_FALSE(same.order);
  EXPECT_EQ(same.error_bar, 0);
  EXPECT_EQ(same.limit, 2);
  const Convergence wrong = convergence_of(h, {1, NAN, 2});
  EXPECT_FALSE(wrong.order);
}

/// Number of nodes of a shape whose scene has [resolution].
template <int D>
Index nodes(const std::string& shape, const std::string& lines, Real k) {
  const SceneInput input = SceneInput::from_text(
      fmt::format("resolution.refine = {}\n[[body]]\nshape = \"{}\"\n{}", k, shape, lines));
  const auto geometry = read_geometry<D>(input.root().tables("body").front());
  input.check();
  return static_cast<Index>(geometry.grid.X.size());
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
  EXPECT_EQ(nodes<3>("half_sphere", "radius = 1\ncore = 4\nlayers = 2\n", 1.3),
            nodes<3>("half_sphere", "radius = 1\ncore = 6\nlayers = 2\n", 1));
  EXPECT_EQ(nodes<3>("box", "size = [1, 2, 3]\nspacing = 0.5\n", 2),
            nodes<3>("box", "size = [1, 2, 3]\ncells = [4, 8, 12]\n", 1));
}

}  // namespace
}  // namespace meniscus::test_convergence
