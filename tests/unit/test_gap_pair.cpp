// SPDX-License-Identifier: BSD-3-Clause
// A law of the gap between two deformable bodies: nearest points, energy of flat surfaces,
// gradient, momenta, range.
#include "contact_support.hpp"
#include "meniscus/error.hpp"
#include "physics/contact/points/contact_facets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meniscus::test_gap_pair {
namespace {

/// Attraction e = -exp(-5 g).
struct Decay final : Interaction {
  PlaneState at(Real gap) const override {
    const Real e = -std::exp(-5 * gap);
    return {e, 5 * e, 25 * e};
  }
  Real range() const override { return 1; }
  Real least_gap() const override { return 0.05; }
  PlaneContact flat() const override { return {}; }
};

template <int D>
std::unique_ptr<ForceTerm> term_of(const test::Pair<D>& pair, int points = 3) {
  ContactChoice choice;
  choice.name = "pair";
  choice.points = points;
  return gap_pair<D>(*pair.first, *pair.second, std::make_shared<Decay>(), choice);
}

/// Two cubes (2D: squares) side by side; the first has the edge 2, the second is larger.
template <int D>
test::Pair<D> blocks(Real gap) {
  Brick<D> small, large;
  small.size.assign(D, 2);
  small.cells.assign(D, 2);
  large.size.assign(D, 6);
  large.size[0] = 2;
  large.cells.assign(D, 6);
  large.cells[0] = 2;
  large.centre.assign(D, 0);
  large.centre[0] = 2 + gap;
  test::Pair<D> pair;
  pair.first = test::with_mass<D>(small.geometry());
  pair.second = test::with_mass<D>(large.geometry(), pair.first->size());
  return pair;
}

TEST(GapPair, NearestPointsAreFound) {
  const auto body = test::body_of<3>(test::brick<3>({2, 2, 2}));
  const ContactFacets<3> facets(*body);
  const auto places = facets.at_rest();
  std::vector<Index> all(places.samples.size() / 3);
  std::iota(all.begin(), all.end(), 0);
  const auto expect = [&](const Vec<3>& x, Real distance, const Vec<3>& normal) {
    const auto foot = facets.foot(places, x, all);
    EXPECT_NEAR(foot.distance, distance, 1e-15);
    EXPECT_LT((foot.normal - normal).norm(), 1e-15);
    Vec<3> y = Vec<3>::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      y += foot.share[k] * at(places.corner, facets.corners_of(foot.facet)[k]);
    EXPECT_LT((x - y - distance * normal).norm(), 1e-15);
  };
  expect({0.3, 0.2, 1.5}, 0.5, {0, 0, 1});                                  // a face
  expect({0.3, 1.3, 1.4}, 0.5, {0, 0.6, 0.8});                              // an edge
  expect({-2, -2, -2}, std::sqrt(3), Vec<3>::Constant(-1 / std::sqrt(3)));  // a corner
  EXPECT_EQ(facets.foot(places, {9, 9, 9}, {}).facet, -1);
}

/// The energy with the switch over the last quarter of the range.
Real energy_at(Real gap) {
  const Real t = std::clamp(4 * gap - 3, 0.0, 1.0);
  return Decay().at(gap).energy * (1 - t * t * t * (10 - t * (15 - 6 * t)));
}

/// The integral over the range, by the midpoint rule.
template <class F>
Real integral(F&& f) {
  constexpr int n = 2000;
  Real sum = 0;
  for (int k = 0; k < n; ++k) sum += f((k + 0.5) / n) / n;
  return sum;
}

/// The small face and the opposite part of the large face have half of area times e(gap) each. All
/// other parts of the surfaces are out of range.
template <int D>
void expect_flat() {
  const Real gap = 0.4, area = D == 3 ? 4 : 2;
  const auto pair = blocks<D>(gap);
  const auto term = term_of<D>(pair, 8);
  const NodalVectors rest = test::zeros(pair.random(1, 1));
  const NodalVectors all = test::force_of(*term, rest);
  // A translation of the small block by dx changes the energy by -force dx.
  NodalVectors push = rest;
  for (Index A = 0; A < pair.first->size(); ++A) at(push, A) = Lanes(1, 0, 0, 0);
  constexpr Real h = 1e-5;
  const Real slope = (test::energy_of(*term, test::sum_of(rest, h, push)) -
                      test::energy_of(*term, test::sum_of(rest, -h, push))) /
                     (2 * h);
  EXPECT_NEAR(test::dot(all, push), -slope, 1e-8);
  const Real strip = integral([&](Real y) { return energy_at(std::hypot(gap, y)); });
  const Real side = integral([&](Real depth) { return energy_at(gap + depth); });
  const Real round =
      integral([&](Real r) { return 2 * std::numbers::pi * r * energy_at(std::hypot(gap, r)); });
  const Real expected =
      area * energy_at(gap) + (D == 3 ? 8 * (strip + side) + round : 2 * (strip + side)) / 2;
  EXPECT_NEAR(test::energy_of(*term, rest), expected, 2e-3 * std::abs(expected));
}

TEST(GapPair, FlatSurfacesHaveTheEnergyOfTheLaw) {
  expect_flat<2>();
  expect_flat<3>();
}

template <int D>
void expect_gradient_and_momenta() {
  const auto pair = test::round_pair<D>(0.35);
  const auto term = term_of<D>(pair);
  for (unsigned seed = 0; seed < 2; ++seed)
    EXPECT_LT(test::gradient_error(*term, pair.random(0.02, seed), pair.random(1, 50 + seed), 1e-4),
              1e-7);
  const NodalVectors u = pair.random(0.02, 3), force = test::force_of(*term, u);
  Eigen::Vector3d net = Eigen::Vector3d::Zero(), torque = net;
  Real size = 0, moment = 0;
  for (const auto* body : {pair.first.get(), pair.second.get()})
    for (Index A = 0; A < body->size(); ++A) {
      const Eigen::Vector3d x = spatial<D>(at(body->particles.X(), A) +
                                           vector_at<D>(u, body->first + A)),
                            f = spatial<D>(vector_at<D>(force, body->first + A));
      net += f;
      torque += Eigen::Vector3d(x[1] * f[2] - x[2] * f[1], x[2] * f[0] - x[0] * f[2],
                                x[0] * f[1] - x[1] * f[0]);
      size += f.norm();
      moment += x.norm() * f.norm();
    }
  EXPECT_GT(size, 0);
  EXPECT_LT(net.norm(), 1e-13 * size);
  EXPECT_LT(torque.norm(), 1e-13 * moment);
}

TEST(GapPair, ForcesAreTheGradientOfTheEnergyAndBalanced) {
  expect_gradient_and_momenta<2>();
  expect_gradient_and_momenta<3>();
}

TEST(GapPair, DoesNothingOutOfRange) {
  const auto pair = test::round_pair<3>(1.01);
  const auto term = term_of<3>(pair);
  const NodalVectors rest = test::zeros(pair.random(1, 1));
  EXPECT_EQ(test::energy_of(*term, rest), 0);
  EXPECT_EQ(test::norm(test::force_of(*term, rest)), 0);
  EXPECT_EQ(test::report_of(*term, rest).demand.stiffness, 0);
}

TEST(GapPair, RejectsStepsIntoOverlaps) {
  const auto pair = blocks<2>(0.04);
  const auto failure = test::report_of(*term_of<2>(pair), test::zeros(pair.random(1, 1))).failure;
  ASSERT_TRUE(failure);
  EXPECT_TRUE(failure->of_step);
  EXPECT_NE(failure->cause.find("is 0.04, least is 0.05"), std::string::npos) << failure->cause;
}

TEST(GapPair, HasTheFormEnergyOnly) {
  const auto pair = test::round_pair<2>(0.35);
  ContactChoice choice;
  choice.form = ContactForm::pressure;
  EXPECT_THROW(gap_pair<2>(*pair.first, *pair.second, std::make_shared<Decay>(), choice),
               InputError);
}

}  // namespace
}  // namespace meniscus::test_gap_pair
