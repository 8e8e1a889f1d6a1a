// SPDX-License-Identifier: BSD-3-Clause
// Supports of particles and the deficiency monitor.
#include "kernel/near_candidates.hpp"
#include "kernel/particle_set.hpp"
#include "meniscus/error.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace meniscus::test_particle_set {
namespace {

TEST(ParticleSet, SupportIsAMultipleOfTheDistanceToANeighbour) {
  const auto geometry = test::brick<3>({5, 4, 6}, 0.3);
  const ParticleSet<3> particles(geometry.grid.X, {1.7, 20}, KernelFunction::cubic_spline);
  for (Index A = 0; A < particles.size(); ++A) {
    std::vector<Real> distance;
    for (const auto& X : particles.X()) distance.push_back((X - at(particles.X(), A)).norm());
    std::sort(distance.begin(), distance.end());
    EXPECT_NEAR(at(particles.support(), A), 1.7 * distance[20], 1e-14);  // [0] is A itself
  }
}

TEST(ParticleSet, CandidatesReachTheBall) {
  const auto geometry = test::brick<2>({9, 8}, 0.3);
  const ParticleSet<2> particles(geometry.grid.X, {1.8, 8}, KernelFunction::cubic_spline);
  const Vec<2> centre(0.3, -1.1);
  std::vector<Candidate<2>> found;
  for (const Real radius : {0.0, 0.7}) {
    particles.candidates(centre, radius, found);
    std::size_t k = 0;
    for (Index A = 0; A < particles.size(); ++A) {
      if ((at(particles.X(), A) - centre).norm() >= radius + at(particles.support(), A)) continue;
      ASSERT_LT(k, found.size());
      EXPECT_EQ(found[k].particle, A);
      EXPECT_EQ(found[k].support, at(particles.support(), A));
      EXPECT_EQ(found[k++].X, at(particles.X(), A));
    }
    EXPECT_EQ(k, found.size());
  }
}

/// The candidates of a ball include all particles whose supports reach into it.
TEST(ParticleSet, StretchedSupportsReachTheBall) {
  Mat<2> stretch;
  stretch << 2, 0, 0, 0.5;
  const auto geometry = test::brick<2>({9, 8}, 0.3);
  const ParticleSet<2> particles(geometry.grid.X, 2.1, KernelFunction::cubic_spline, stretch);
  const Vec<2> centre(0.3, -1.1);
  std::vector<Candidate<2>> found;
  particles.candidates(centre, 0.7, found);
  for (Index A = 0; A < particles.size(); ++A)
    for (int k = 0; k < 100; ++k) {
      const Real angle = 0.0628 * k;
      const Vec<2> x = centre + 0.7 * Vec<2>(std::cos(angle), std::sin(angle)),
                   d = at(particles.X(), A) - x;
      if (std::hypot(d[0] / 2, 2 * d[1]) >= 2.1) continue;
      EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                              [&](const Candidate<2>& c) { return c.particle == A; }));
    }
}

TEST(ParticleSet, GoodSupportsAreLeftAlone) {
  const auto geometry = test::ball(4, 2);
  ParticleSet<3> particles(geometry.grid.X, ParticleSet<3>::AdaptiveSupport{},
                           KernelFunction::cubic_spline);
  const std::vector<Real> before(particles.support().begin(), particles.support().end());
  EXPECT_EQ(particles.ensure_quality(geometry.grid.X, "ball"), 0);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), particles.support().begin()));
}

template <int D>
void expect_enlargement(Geometry<D> geometry, Real support) {
  const auto points = cell_gauss_points(geometry.grid, 2).X;
  ParticleSet<D> particles(geometry.grid.X, support, KernelFunction::cubic_spline);
  EXPECT_THROW(build_point_rows<D>(particles, points, {.value = true}, "brick"), SolveError);
  const Index enlarged = particles.ensure_quality(points, "brick");
  EXPECT_GT(enlarged, 0);
  Index changed = 0;
  for (const Real s : particles.support()) {
    EXPECT_GE(s, support);
    EXPECT_LE(s, 2.6 * support);
    changed += s > support;
  }
  EXPECT_EQ(changed, enlarged);
  EXPECT_NO_THROW(build_point_rows<D>(particles, points, {.value = true}, "brick"));
  EXPECT_EQ(particles.ensure_quality(points, "brick"), 0);  // now the quality is good
}

TEST(ParticleSet, TooSmallSupportsAreEnlarged) {
  expect_enlargement<2>(test::brick<2>({8, 8}), 1.3);
  expect_enlargement<3>(test::brick<3>({5, 5, 5}), 1.5);
  expect_enlargement<3>(test::brick<3>({5, 5, 5}, 0.4), 1.5);
}

TEST(ParticleSet, OnlyParticlesNearAPoorPointAreEnlarged) {
  // One particle of a good lattice has no near neighbours.
  std::vector<Vec<2>> X;
  for (int i = 0; i < 24; ++i)
    for (int j = 0; j < 24; ++j)
      if (std::hypot(i - 5, j - 5) > 2.3 || (i == 5 && j == 5)) X.push_back(Vec<2>(i, j));
  ParticleSet<2> particles(X, 2.3, KernelFunction::cubic_spline);
  const Index enlarged = particles.ensure_quality(X, "plate");
  EXPECT_GT(enlarged, 0);
  for (Index A = 0; A < particles.size(); ++A)
    if (at(particles.support(), A) > 2.3) {
      EXPECT_LT((at(X, A) - Vec<2>(5, 5)).norm(), 8) << A;
    }
}

std::string refusal(ParticleSet<3> particles) {
  const std::vector<Vec<3>> points(particles.X().begin(), particles.X().end());
  try {
    particles.ensure_quality(points, "leaf");
  } catch (const SolveError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(ParticleSet, ParticlesInAPlaneAreRefused) {
  std::vector<Vec<3>> X;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) X.push_back(Vec<3>(i, j, 3));
  for (const bool adaptive : {false, true}) {
    const std::string what =
        adaptive ? refusal({X, ParticleSet<3>::AdaptiveSupport{}, KernelFunction::cubic_spline})
                 : refusal({X, 2.6, KernelFunction::cubic_spline});
    EXPECT_NE(what.find("body 'leaf'"), std::string::npos) << what;
    EXPECT_NE(what.find("point (0, 0, 3)"), std::string::npos) << what;
    EXPECT_NE(what.find(" neighbours"), std::string::npos) << what;
    EXPECT_NE(what.find("use two layers of cells or more"), std::string::npos) << what;
  }
}

/// One layer of cells in any direction: no support is large enough for quadratic shape functions.
TEST(ParticleSet, ParticlesInTwoPlanesAreToldThatTheyNeedAThird) {
  const Vec<3> e = Vec<3>(1, 2, 2) / 3, f = Vec<3>(2, 1, -2) / 3, g = Vec<3>(2, -2, 1) / 3;
  for (const int layers : {2, 3}) {
    std::vector<Vec<3>> X;
    for (int k = 0; k < layers; ++k)
      for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j) X.push_back(i * e + j * f + k * g);
    const std::string what = refusal({X, 2.6, KernelFunction::cubic_spline});
    if (layers == 2)
      EXPECT_NE(what.find("use two layers of cells or more"), std::string::npos) << what;
    else
      EXPECT_EQ(what, "accepted");
  }
}

TEST(ParticleSet, TooFewParticlesAreRefused) {
  const std::vector<Vec<3>> X{Vec<3>(0, 0, 0), Vec<3>(1, 0, 0), Vec<3>(0, 1, 0), Vec<3>(0, 0, 1)};
  EXPECT_NE(refusal({X, 9.0, KernelFunction::cubic_spline}).find(": 4 neighbours"),
            std::string::npos);
}

TEST(ParticleSet, TwoParticlesInOnePlaceAreNoHarm) {
  std::vector<Vec<3>> X = test::brick<3>({4, 4, 4}).grid.X;
  X.push_back(X[60]);
  ParticleSet<3> particles(X, 2.6, KernelFunction::cubic_spline);
  EXPECT_EQ(particles.ensure_quality(X, "brick"), 0);
}

}  // namespace
/// The selection is right for any number of candidates, also after calls with other numbers.
TEST(NearCandidates, AreThoseThatReachOneOfFourPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> anywhere(-1, 1), support(0.2, 0.8);
  NearCandidates<3> near;
  for (const std::size_t count : {0, 1, 3, 50, 4, 7}) {
    std::vector<Candidate<3>> all;
    for (std::size_t k = 0; k < count; ++k)
      all.push_back({static_cast<Index>(100 + k),
                     support(random),
                     {anywhere(random), anywhere(random), anywhere(random)}});
    near.begin(all);
    for (int batch = 0; batch < 5; ++batch) {
      std::array<Vec<3>, 4> points;
      for (Vec<3>& x : points) x = {anywhere(random), anywhere(random), anywhere(random)};
      near.select(points);
      std::vector<Index> expected;
      for (std::size_t k = 0; k < count; ++k)
        if (std::any_of(points.begin(), points.end(),
                        [&](const Vec<3>& x) { return (x - all[k].X).norm() < all[k].support; }))
          expected.push_back(static_cast<Index>(k));
      EXPECT_EQ(std::vector<Index>(near.numbers().begin(), near.numbers().end()), expected);
      ASSERT_EQ(near.near().size(), expected.size());
      for (std::size_t k = 0; k < expected.size(); ++k)
        EXPECT_EQ(near.near()[k].particle, 100 + expected[k]);
    }
  }
}

}  // namespace meniscus::test_particle_set
