// SPDX-License-Identifier: BSD-3-Clause
// Surfaces that pass through themselves or each other are detected, at a place known by hand.
// Surfaces that touch, enclose each other or bend are accepted.
#include "body/particle_values.hpp"
#include "contact_support.hpp"
#include "physics/surface/surface_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace meniscus {
namespace {

template <int D>
std::optional<Crossing<D>> crossing_of(const std::vector<std::array<Index, D>>& simplices,
                                       const std::vector<Vec<D>>& x) {
  std::vector<Index> group(simplices.size(), 0);
  return CrossingSearch<D>(simplices, group, x).deepest(x);
}

TEST(Crossings, OfTwoSegments) {
  const auto found = [](Vec<2> p, Vec<2> q) {
    return crossing_of<2>({{0, 1}, {2, 3}}, {{0, 0}, {4, 0}, p, q});
  };
  const auto crossing = found({1, 1.5}, {1, -1});
  ASSERT_TRUE(crossing);
  EXPECT_EQ(crossing->place, Vec<2>(1, 0));
  EXPECT_EQ(crossing->depth, 1);
  EXPECT_EQ(crossing->share, 0.25);
  EXPECT_FALSE(found({1, 1.5}, {1, 0}));      // touches
  EXPECT_FALSE(found({1, 1.5}, {1, 1e-9}));   // nearly
  EXPECT_FALSE(found({1, 1.5}, {1, -1e-9}));  // round-off
  EXPECT_FALSE(found({4.01, 1.5}, {4.01, -1}));
  EXPECT_FALSE(found({1, 0}, {3, 0}));  // lies on it
  EXPECT_FALSE(found({1, 1.5}, {1, std::numeric_limits<Real>::quiet_NaN()}));
  // Neighbours meet at their corner.
  EXPECT_FALSE(crossing_of<2>({{0, 1}, {1, 2}}, {{0, 0}, {4, 0}, {1, 1e-3}}));
}

TEST(Crossings, OfTwoTriangles) {
  const std::vector<Vec<3>> flat{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto found = [&](Vec<3> a, Vec<3> b, Vec<3> c) {
    std::vector<Vec<3>> x = flat;
    x.insert(x.end(), {a, b, c});
    return crossing_of<3>({{0, 1, 2}, {3, 4, 5}}, x);
  };
  const auto crossing = found({1, 1, -1}, {1, 1, 2}, {9, 9, 2});
  ASSERT_TRUE(crossing);
  EXPECT_LT((crossing->place - Vec<3>(1, 1, 0)).norm(), 1e-15);
  EXPECT_NEAR(crossing->depth, 1, 1e-15);
  EXPECT_EQ(crossing->first, 1);
  EXPECT_EQ(crossing->second, 0);
  EXPECT_FALSE(found({1, 1, 0}, {1, 1, 2}, {9, 9, 2}));      // a corner touches
  EXPECT_FALSE(found({1, 1, -1e-9}, {1, 1, 2}, {9, 9, 2}));  // round-off
  EXPECT_FALSE(found({1, 1, 0}, {2, 1, 0}, {1, 2, 0}));      // lies on it
  EXPECT_FALSE(found({3, 3, -1}, {3, 3, 2}, {9, 9, 2}));     // beside it
  // Two facets with a common corner, one of which is folded through the other.
  const std::vector<std::array<Index, 3>> fan{{0, 1, 2}, {0, 3, 4}};
  EXPECT_TRUE(crossing_of<3>(fan, {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, -1}}));
  EXPECT_FALSE(crossing_of<3>(fan, {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1}, {1, 1, 2}}));
}

/// The search by boxes finds the same crossings as a comparison of all pairs, for any positions.
TEST(Crossings, BoxesMissNothing) {
  const auto ball = test::with_mass<3>(test::ball(4, 2));
  const auto simplices = triangulate_boundary(ball->geometry.grid);
  const auto at_rest = ball->geometry.grid.X;
  const CrossingSearch<3> search(simplices, std::vector<Index>(simplices.size(), 0), at_rest);
  EXPECT_FALSE(search.deepest(at_rest));
  for (unsigned seed = 1; seed <= 6; ++seed) {
    std::vector<Vec<3>> x = at_rest;
    const NodalVectors u = test::random_field<3>(ball->size(), 0.1 * (1 + seed % 3), seed);
    for (std::size_t A = 0; A < x.size(); ++A)
      for (int i = 0; i < 3; ++i) x[A][i] += u[A][i];
    Real deepest = 0;
    for (std::size_t a = 0; a < simplices.size(); ++a)
      for (std::size_t b = a + 1; b < simplices.size(); ++b)
        if (const auto one = crossing_of<3>({simplices[a], simplices[b]}, x))
          deepest = std::max(deepest, one->share);
    const auto found = search.deepest(x);
    EXPECT_EQ(found ? found->share : 0, deepest) << seed;
  }
}

template <int D>
std::optional<Failure> check(std::vector<const Body<D>*> bodies, const NodalVectors& u) {
  const NodalVectors v = test::zeros(u);
  const SurfaceCheck<D> surfaces(std::move(bodies),
                                 [](std::size_t a, std::size_t b) { return a == b ? "A" : "B"; });
  return surfaces.find({0, u, v});
}

/// Coefficients for which the material points have the positions x(X).
template <int D, class Place>
NodalVectors moved(const Body<D>& body, Place&& place) {
  const NodalVectors goal =
      test::field_on<D>(body, [&](const Vec<D>& X) { return Vec<D>(place(X) - X); });
  NodalVectors u = goal;
  for (int sweep = 0; sweep < 60; ++sweep) {
    const NodalVectors values = values_at_particles(body, u.data());
    for (std::size_t A = 0; A < u.size(); ++A) u[A] += goal[A] - values[A];
  }
  return u;
}

template <int D>
void expect_balls() {
  const auto cause_at = [](Real gap) {
    const auto pair = test::round_pair<D>(gap);
    const NodalVectors u = pair.field([](const Vec<D>&) { return Vec<D>(Vec<D>::Zero()); });
    const auto failure = check<D>({pair.first.get(), pair.second.get()}, u);
    return failure ? failure->cause : std::string();
  };
  for (const Real gap : {1.0, 0.01, 0.0, -0.001}) EXPECT_EQ(cause_at(gap), "") << gap;
  for (const Real gap : {-0.2, -0.3, -0.5, -1.0}) {
    EXPECT_NE(cause_at(gap).find("goes through body '"), std::string::npos) << gap;
    EXPECT_TRUE(cause_at(gap).ends_with("B")) << gap;
  }
}

TEST(SurfaceCheck, BallsThatOverlapAndBallsThatTouch) {
  expect_balls<2>();
  expect_balls<3>();
}

TEST(SurfaceCheck, ABallMayLieInACavityButNotInItsWall) {
  SphereShell shape;
  shape.radius = 2;
  shape.thickness = 0.5;
  shape.layers = 2;
  shape.spacing = 0.4;
  const auto hollow = test::with_mass<3>(shape.geometry());
  const auto ball = test::with_mass<3>(test::ball(4, 2), hollow->size());
  for (const auto& [shift, crosses] : {std::pair(0.0, false), {0.5, false}, {0.9, true}}) {
    NodalVectors u(static_cast<std::size_t>(hollow->size() + ball->size()), Lanes::zero());
    for (Index A = 0; A < ball->size(); ++A) at(u, ball->first + A) = Lanes(shift, 0, 0, 0);
    EXPECT_EQ(check<3>({hollow.get(), ball.get()}, u).has_value(), crosses) << shift;
  }
}

/// A bar bent to a circle and a little more: its end runs into its beginning, half of its thickness
/// farther out.
TEST(SurfaceCheck, ABarBentBeyondACircle) {
  const auto bar = test::with_mass<2>(test::brick<2>({40, 2}));
  for (const Real turns : {0.5, 0.9, 0.96, 1.05, 1.3}) {
    const Real radius = 40 / (2 * std::numbers::pi * turns);
    const NodalVectors u = moved<2>(*bar, [&](const Vec<2>& X) {
      const Real angle = X[0] / radius, r = radius - (X[1] - 1) + X[0] / 40;
      return Vec<2>(r * std::sin(angle), radius - r * std::cos(angle));
    });
    const auto failure = check<2>({bar.get()}, u);
    EXPECT_EQ(failure.has_value(), turns > 1) << turns;
    EXPECT_EQ(failure && failure->cause.find("goes through itself") != std::string::npos,
              turns > 1);
  }
}

TEST(SurfaceCheck, AFaceThatIsTurnedInsideOut) {
  const auto disk = test::with_mass<2>(test::disk(4, 2));
  const auto mirrored =
      check<2>({disk.get()}, moved<2>(*disk, [](const Vec<2>& X) { return Vec<2>(-X[0], X[1]); }));
  ASSERT_TRUE(mirrored);
  EXPECT_NE(mirrored->cause.find("turned inside out"), std::string::npos) << mirrored->cause;
  EXPECT_FALSE(check<2>({disk.get()}, moved<2>(*disk, [](const Vec<2>& X) {
                          return Vec<2>(-X[0], -X[1]);  // half a turn
                        })));
  // Positions that are NaN enclose nothing.
  NodalVectors u = moved<2>(*disk, [](const Vec<2>& X) { return X; });
  u[0] = Lanes(std::numeric_limits<Real>::quiet_NaN());
  EXPECT_TRUE(check<2>({disk.get()}, u));
}

/// The inner face of a ring is pushed through the centre.
TEST(SurfaceCheck, ARingWhoseInnerFaceIsPushedThroughItself) {
  Ring shape;
  shape.radius = 1;
  shape.thickness = 0.3;
  shape.layers = 2;
  shape.around = 60;
  const auto ring = test::with_mass<2>(shape.geometry());
  for (const Real flat : {0.2, 0.02, -0.2}) {
    // Squeezed between two sides: the inner face is at +-flat in the middle.
    const auto failure = check<2>({ring.get()}, moved<2>(*ring, [&](const Vec<2>& X) {
                                    const Real squeeze =
                                        std::exp(-std::pow(X[0] / 0.4, 2)) * (0.7 - flat);
                                    return Vec<2>(X[0], X[1] - std::copysign(squeeze, X[1]));
                                  }));
    EXPECT_EQ(failure.has_value(), flat < 0) << flat;
  }
}

}  // namespace
}  // namespace meniscus
