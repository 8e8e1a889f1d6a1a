// SPDX-License-Identifier: BSD-3-Clause
// Contact points shared by several contacts of a body, or divided between ranks.
#include "body/shared_parts.hpp"
#include "contact_support.hpp"
#include "parallel/thread_ranks.hpp"
#include "physics/contact/pair/contact_demand.hpp"
#include "physics/contact/points/contact_points.hpp"

#include <gtest/gtest.h>

#include <random>

namespace meniscus::test_shared_contact_points {
namespace {

TEST(SharedParts, AreMadeOnceAndKeptWhileOneHasThem) {
  SharedParts parts;
  int made = 0;
  const auto get = [&](const std::string& name) {
    return parts.get<int>(name, [&] { return std::make_shared<int>(++made); });
  };
  auto first = get("a");
  EXPECT_EQ(first, get("a"));
  EXPECT_EQ(made, 1);
  const auto other = get("b");
  EXPECT_NE(first, other);
  first.reset();
  EXPECT_EQ(*get("a"), 3);
}

template <int D>
NodalVectors force_of(ForceTerm& contact, const NodalVectors& u) {
  const NodalVectors v(u.size(), Lanes::zero());
  NodalVectors force = v;
  contact.add_force({0, u, v}, force);
  return force;
}

/// Two contacts of the same bodies with different weights share their points. Each has the same
/// force as without the other.
template <int D>
void expect_force_of_one_alone(ContactForm form) {
  const ContactLaw law = test::law<D>();
  const auto alone = test::round_pair<D>(0.35), both = test::round_pair<D>(0.35);
  const NodalVectors u = alone.random(0.01, 3);
  const auto expected_term = test::contact_of<D>(alone, law, form);
  ContactChoice choice;
  choice.form = form;
  choice.density = form == ContactForm::volume ? SiteDensity::constant : SiteDensity::referential;
  const auto other = contact_pair<D>({*both.first, 3.0}, {*both.second, 2.0}, law, choice);
  const auto term = test::contact_of<D>(both, law, form);
  const NodalVectors expected = force_of<D>(*expected_term, u);
  force_of<D>(*other, u);
  const NodalVectors force = force_of<D>(*term, u);
  force_of<D>(*other, u);
  for (std::size_t A = 0; A < force.size(); ++A)
    for (int i = 0; i < D; ++i) ASSERT_EQ(force[A][i], expected[A][i]);
  EXPECT_LT(term->bytes(), expected_term->bytes() / 2);
  EXPECT_EQ(other->bytes(), expected_term->bytes());
  EXPECT_EQ(term->pairs(), expected_term->pairs());
}

TEST(SharedContactPoints, GiveEachContactTheForceThatItHasAlone) {
  for (const ContactForm form : {ContactForm::energy, ContactForm::volume}) {
    expect_force_of_one_alone<2>(form);
    expect_force_of_one_alone<3>(form);
  }
}

/// Each rank places the points whose rows it has; gathered, they have the bits of points that one
/// rank has moved. F^-1 is known where the rows are.
void expect_points_placed_together(const ContactPoints<3>& points, const Motion& motion) {
  std::vector<Index> listed;
  for (Index c = 0; c < points.clusters(); c += 3) listed.push_back(c);
  ContactPlaces<3> all = points.at_rest();
  points.move(listed, motion, all);
  points.update_weights(listed, motion, all);
  using Placed = ContactPoints<3>::Placed;
  as_ranks(3, [&] {
    const SharedWork work = SharedWork::of_all();
    ContactPlaces<3> places = points.at_rest();
    GatherTogether()({{points.place(listed, work, Placed::weights, motion, places)}});
    points.take_placed(listed, work, Placed::weights, places);
    const ItemRange own = points.rows_of(listed, work).own();
    for (Index k = 0; k < static_cast<Index>(listed.size()); ++k)
      for (int i = 0; i < 3; ++i)
        for (int lane = 0; lane < Lanes::width; ++lane) {
          const Index c = at(listed, k);
          EXPECT_EQ(places.x_of(c)[i][lane], all.x_of(c)[i][lane]);
          EXPECT_EQ(places.weight_of(c)[i][lane], all.weight_of(c)[i][lane]);
          if (!points.on_patches() && k >= own.begin && k < own.end) {
            EXPECT_EQ(at(places.inverse, c)(i, 0)[lane], at(all.inverse, c)(i, 0)[lane]);
          }
        }
  });
}

TEST(ContactPoints, OfAListArePlacedTogether) {
  const auto pair = test::round_pair<3>(0.35);
  const NodalVectors u = pair.random(0.05, 3);
  const Motion motion{0, u, u};
  expect_points_placed_together(
      ContactPoints<3>::on_surface(*pair.first, 1, SiteDensity::constant, 2), motion);
  expect_points_placed_together(ContactPoints<3>::on_patches(*pair.first, 1, 2), motion);
}

ContactPlaces<3> cloud(Real from, Real to, int count, std::mt19937& generator) {
  std::uniform_real_distribution<Real> along(from, to), across(-1, 1);
  ContactPlaces<3> places{
      count, 3, AlignedVector<Lanes>(static_cast<std::size_t>(count), Lanes::zero()), {}, {}};
  for (Index c = 0; c < count / Lanes::width; ++c)
    for (int lane = 0; lane < Lanes::width; ++lane) {
      at(places.x, c * 3).set(lane, along(generator));
      at(places.x, c * 3 + 1).set(lane, across(generator));
      at(places.x, c * 3 + 2).set(lane, across(generator));
    }
  return places;
}

/// Tests clouds that are apart, side by side and overlapping.
TEST(Gap, IsTheLeastDistanceOfAnyTwoPoints) {
  std::mt19937 generator(5);
  for (const Real away : {3.0, 1.0, 0.9, 0.3, 0.0}) {
    const ContactPlaces<3> first = cloud(-1, 0, 100, generator),
                           second = cloud(away - 1, away, 140, generator);
    Real least = unbounded;
    for (Index p = 0; p < first.size; ++p)
      for (Index q = 0; q < second.size; ++q)
        least = std::min(least, (first.place(p) - second.place(q)).norm());
    EXPECT_NEAR(gap_between(first, second), least, 1e-15 * (1 + least)) << away;
    EXPECT_EQ(gap_between(first, second), gap_between(second, first)) << away;
  }
}

}  // namespace
}  // namespace meniscus::test_shared_contact_points
