// SPDX-License-Identifier: BSD-3-Clause
// Contact points that several contacts of a body have together.
#include "meniscus/core/shared_parts.hpp"
#include "meniscus/physics/contact_points.hpp"

#include <gtest/gtest.h>

#include "contact_support.hpp"

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

/// A contact beside another one of the same bodies, which differs in its weights, has the force
/// that it has alone.
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

}  // namespace
}  // namespace meniscus::test_shared_contact_points
