// SPDX-License-Identifier: BSD-3-Clause
// Contact of deformable bodies with each other and with rigid partners: gradients of energies,
// momenta, overlaps, and limits of the time step.
#include "contact_support.hpp"
#include "meniscus/error.hpp"
#include "physics/contact/pair/contact_visits.hpp"
#include "thrown.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace meniscus::test_contact {
namespace {

template <int D>
const std::vector<PairKernel>& kernels() {
  static const std::vector<PairKernel> all =
      D == 3 ? std::vector{PairKernel::space}
             : std::vector{PairKernel::integrated, PairKernel::planar};
  return all;
}

template <int D>
void expect_gradient(ForceTerm& term, Index size, Real tolerance) {
  for (unsigned seed = 0; seed < 2; ++seed) {
    const NodalVectors u = test::random_field<D>(size, 0.02, seed);
    const NodalVectors direction = test::random_field<D>(size, 1, 50 + seed);
    EXPECT_LT(test::gradient_error(term, u, direction, 4e-4), tolerance) << term.name();
  }
}

template <int D>
void expect_pair_gradients() {
  const auto pair = test::round_pair<D>(0.35);
  for (const PairKernel kernel : kernels<D>()) {
    const ContactLaw law = test::law<D>(kernel);
    for (const SiteDensity density : {SiteDensity::constant, SiteDensity::referential})
      expect_gradient<D>(*test::contact_of<D>(pair, law, ContactForm::energy, density), pair.size(),
                         1e-8);
    // The force of the cut-off law jumps at both ends of its switch; here the switch is far away.
    ContactLaw far = law;
    far.cutoff = 20;
    expect_gradient<D>(*test::contact_of<D>(pair, far, ContactForm::volume), pair.size(), 1e-8);
  }
}

TEST(Contact, ForcesAreTheGradientOfTheEnergy) {
  expect_pair_gradients<2>();
  expect_pair_gradients<3>();
}

template <int D>
test::Balance pair_balance(ContactForm form, SiteDensity density = SiteDensity::constant) {
  const auto pair = test::round_pair<D>(0.35);
  const NodalVectors u = pair.field([](const Vec<D>& X) {
    Vec<D> w = 0.05 * X;
    w[0] += 0.1 * std::sin(X[1]);
    w[D - 1] += 0.03 * X[0] * X[0];
    return w;
  });
  const auto term = test::contact_of<D>(pair, test::law<D>(), form, density);
  const NodalVectors force = test::force_of(*term, u);
  EXPECT_GT(test::norm(force), 0);
  // Net force and torque of both bodies together.
  Eigen::Vector3d net = Eigen::Vector3d::Zero(), moment = net;
  Real force_scale = 0, torque_scale = 0;
  for (const auto* body : {pair.first.get(), pair.second.get()})
    for (Index A = 0; A < body->size(); ++A) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero(), f = x;
      x.head<D>() = at(body->particles.X(), A) + vector_at<D>(u, body->first + A);
      f.head<D>() = vector_at<D>(force, body->first + A);
      net += f;
      moment += Eigen::Vector3d(x[1] * f[2] - x[2] * f[1], x[2] * f[0] - x[0] * f[2],
                                x[0] * f[1] - x[1] * f[0]);
      force_scale += f.norm();
      torque_scale += x.norm() * f.norm();
    }
  return {net.norm() / force_scale, moment.norm() / torque_scale};
}

TEST(Contact, ConservesMomenta) {
  for (const ContactForm form : {ContactForm::energy, ContactForm::volume}) {
    const auto plane = pair_balance<2>(form), space = pair_balance<3>(form);
    EXPECT_LT(std::max(plane.force, space.force), 1e-13);
    EXPECT_LT(std::max(plane.torque, space.torque), 1e-13);
  }
  const auto referential = pair_balance<3>(ContactForm::energy, SiteDensity::referential);
  EXPECT_LT(std::max(referential.force, referential.torque), 1e-13);
}

/// The traction of the dissertation is not a gradient, and its discrete sums are not balanced.
TEST(Contact, DissertationFormConservesNothing) {
  const auto balance = pair_balance<3>(ContactForm::dissertation);
  EXPECT_GT(balance.force, 1e-6);
  const auto pair = test::round_pair<3>(0.35);
  const auto term = test::contact_of<3>(pair, test::law<3>(), ContactForm::dissertation);
  // The direction spreads the surfaces apart. Along a translation the form would have the right
  // work.
  const NodalVectors u = test::zeros(pair.random(1, 1));
  const NodalVectors spread =
      pair.field([](const Vec<3>& X) { return Vec<3>(-X[0], 0.5 * X[1], 0.5 * X[2]); });
  EXPECT_GT(test::gradient_error(*term, u, spread, 4e-4), 0.1);
}

template <int D>
std::vector<std::pair<std::string, std::unique_ptr<RigidPartner<D>>>> partners(
    const ContactLaw& law) {
  std::vector<std::pair<std::string, std::unique_ptr<RigidPartner<D>>>> all;
  Vec<D> tilted = Vec<D>::Constant(0.4), below = Vec<D>::Zero();
  tilted[D - 1] = 1;
  below = -1.4 * tilted.normalized();
  all.emplace_back("half space", rigid_half_space<D>(law, 0.7, below, tilted));
  all.emplace_back("ball", rigid_ball<D>(law, 0.7, 1.5 * below, 0.7));
  all.emplace_back("cavity", rigid_cavity<D>(law, 0.7, 0.1 * below, 1.6));
  if constexpr (D == 2)
    all.emplace_back("frame", rigid_frame(law, 0.7, Vec<2>(-1.5, -1.4), Vec<2>(3, 3)));
  return all;
}

template <int D>
void expect_rigid_gradients() {
  const auto body = test::with_mass<D>(test::round<D>(Vec<D>::Zero()));
  for (const PairKernel kernel : kernels<D>()) {
    ContactLaw law = test::law<D>(kernel);
    law.cutoff = std::numeric_limits<Real>::infinity();
    for (auto& [name, partner] : partners<D>(law)) {
      SCOPED_TRACE(name);
      ContactChoice choice;
      choice.name = name;
      MovingPartner<D> moving;
      moving.shape = std::move(partner);
      moving.beta = 0.7;
      const auto term = rigid_contact<D>({*body, 1.2}, std::move(moving), law, choice);
      expect_gradient<D>(*term, body->size(), 1e-7);
      EXPECT_FALSE(test::report_of(*term, NodalVectors(body->mass.size(), Lanes::zero())).failure);
    }
  }
}

TEST(Contact, RigidPartnersActByTheGradientOfTheEnergy) {
  expect_rigid_gradients<2>();
  expect_rigid_gradients<3>();
}

/// A list that was built at other positions gives the same bits.
template <int D>
void expect_same_bits_after(Real detour) {
  const auto pair = test::round_pair<D>(0.35);
  for (const ContactForm form : {ContactForm::energy, ContactForm::volume}) {
    const NodalVectors u = pair.random(0.01, 1);
    const auto fresh = test::contact_of<D>(pair, test::law<D>(), form);
    const NodalVectors expected = test::force_of(*fresh, u);
    const auto used = test::contact_of<D>(pair, test::law<D>(), form);
    test::force_of(*used, test::sum_of(u, detour, pair.field([](const Vec<D>&) {
      Vec<D> w = Vec<D>::Zero();
      w[0] = 1;
      return w;
    })));
    NodalVectors moved = u;
    for (Index A = 0; A < pair.first->size(); ++A) at(moved, A) += Lanes(-detour, 0, 0, 0);
    test::force_of(*used, moved);
    const NodalVectors again = test::force_of(*used, u);
    EXPECT_EQ(0, std::memcmp(again.data(), expected.data(), again.size() * sizeof(Lanes)));
    EXPECT_EQ(test::energy_of(*used, u), test::energy_of(*fresh, u));
  }
}

TEST(Contact, BitsDoNotDependOnWhenTheListWasBuilt) {
  for (const Real detour : {0.05, 0.15, 1.0}) {
    expect_same_bits_after<2>(detour);
    expect_same_bits_after<3>(detour);
  }
}

/// The step limit of a force does not depend on when the list was built. (A restart builds it
/// again.)
template <int D>
void expect_same_demand_after(Real detour, Real gap) {
  SCOPED_TRACE(std::to_string(D) + "D, gap " + std::to_string(gap));
  const auto pair = test::round_pair<D>(gap);
  const NodalVectors u = pair.random(0.01, 1), v = pair.random(1, 2);
  const auto fresh = test::contact_of<D>(pair, test::law<D>(), ContactForm::energy),
             used = test::contact_of<D>(pair, test::law<D>(), ContactForm::energy);
  NodalVectors before = u;
  for (Index A = 0; A < pair.first->size(); ++A) at(before, A) += Lanes(detour, 0, 0, 0);
  test::force_of(*used, before);
  const StepDemand expected = test::report_of(*fresh, u, v).demand,
                   again = test::report_of(*used, u, v).demand;
  EXPECT_EQ(again.longest, expected.longest);
  EXPECT_EQ(again.stiffness, expected.stiffness);
}

TEST(Contact, DemandsDoNotDependOnWhenTheListWasBuilt) {
  // Detours stay within the skin of 0.2. The gaps are small, just within the reach of 2, and beyond
  // it.
  for (const Real detour : {-0.12, -0.05, 0.05, 0.12})
    for (const Real gap : {0.35, 1.95, 2.1}) {
      expect_same_demand_after<2>(detour, gap);
      expect_same_demand_after<3>(detour, gap);
    }
}

/// A displacement that turns the first body by `angle` about its centre, moves the second one by
/// `nearer`, and deforms both.
template <int D>
NodalVectors turned_and_nearer(const test::Pair<D>& pair, Real angle, Real nearer, Real deformed,
                               unsigned seed) {
  NodalVectors u = pair.random(deformed, seed);
  for (Index A = 0; A < pair.size(); ++A) {
    if (A >= pair.first->size()) {
      at(u, A) += Lanes(-nearer, 0, 0, 0);
      continue;
    }
    const Vec<D>& X = at(pair.first->particles.X(), A);
    at(u, A) += Lanes((std::cos(angle) - 1) * X[0] - std::sin(angle) * X[1],
                      std::sin(angle) * X[0] + (std::cos(angle) - 1) * X[1], 0, 0);
  }
  return u;
}

/// Points that are not moved while they are far from the other body change no result: at every
/// motion, a term with this history has the same bits as a new term.
template <int D>
void expect_fresh_bits_on_the_way(int points) {
  SCOPED_TRACE(std::to_string(D) + "D, " + std::to_string(points) + " points");
  const auto pair = test::round_pair<D>(2.4);  // beyond the reach of 2
  ContactChoice choice;
  choice.name = "pair";
  choice.points = points;
  const auto term = [&] {
    return contact_pair<D>({*pair.first, 1.2}, {*pair.second, 0.7}, test::law<D>(), choice);
  };
  const auto used = term();
  struct Stage {
    Real angle, nearer, deformed;
  };
  // A fast approach, a spin that brings the far side near, large deformations between two builds of
  // the list, small steps that keep the list, and a retreat.
  const std::vector<Stage> stages{{0, 0, 0.01},      {0, 2, 0.01},     {0.9, 2, 0.01},
                                  {1.8, 2.05, 0.02}, {3.1, 2.05, 0.1}, {3.1, 2.06, 0.1},
                                  {3.12, 2.08, 0.1}, {3.1, 1, 0.05},   {3.1, -1, 0.01}};
  unsigned seed = 0;
  for (const Stage& s : stages) {
    const NodalVectors u =
        turned_and_nearer<D>(pair, s.angle, s.nearer, s.deformed, s.deformed < 0.1 ? ++seed : 99);
    const auto fresh = term();
    const NodalVectors expected = test::force_of(*fresh, u), f = test::force_of(*used, u);
    EXPECT_EQ(0, std::memcmp(f.data(), expected.data(), f.size() * sizeof(Lanes))) << s.angle;
    EXPECT_EQ(test::energy_of(*used, u), test::energy_of(*fresh, u)) << s.angle;
    const NodalVectors v = pair.random(1, 5);
    EXPECT_EQ(test::report_of(*used, u, v).demand.longest,
              test::report_of(*fresh, u, v).demand.longest);
  }
}

TEST(Contact, PointsLeftBehindChangeNothing) {
  for (const int points : {2, 5}) {
    expect_fresh_bits_on_the_way<2>(points);
    expect_fresh_bits_on_the_way<3>(points);
  }
}

TEST(Contact, CountsThePairsItVisits) {
  const auto visited = [](Real gap, int points) {
    const auto pair = test::round_pair<3>(gap);
    ContactChoice choice;
    choice.points = points;
    const auto term = contact_pair<3>({*pair.first, 1}, {*pair.second, 1}, test::law<3>(), choice);
    const auto* visits = dynamic_cast<const ContactVisits*>(term.get());
    EXPECT_EQ(visits->pairs_per_force(), 0);
    const NodalVectors still = test::zeros(pair.random(1, 1));
    test::force_of(*term, still);
    test::force_of(*term, still);
    return visits->pairs_per_force();
  };
  const Real facets = 96, all = 2 * std::pow(facets * 36, 2);
  EXPECT_EQ(visited(3, 6), 0);
  EXPECT_GT(visited(1.5, 6), 0);
  EXPECT_LT(visited(1.5, 6), visited(0.5, 6));
  EXPECT_LT(visited(0.5, 6), 0.3 * all);
}

TEST(Contact, OverlapIsAFailureOfTheStep) {
  const auto close = test::round_pair<3>(0.1), far = test::round_pair<3>(0.35);
  for (const auto* pair : {&close, &far}) {
    const auto term = test::contact_of<3>(*pair, test::law<3>(), ContactForm::energy);
    const NodalVectors still = test::zeros(pair->random(1, 1));
    const auto failure = test::report_of(*term, still).failure;
    EXPECT_EQ(failure.has_value(), pair == &close);
    if (!failure) continue;
    EXPECT_TRUE(failure->of_step);
    EXPECT_NE(failure->cause.find("sigma0"), std::string::npos) << failure->cause;
    EXPECT_LT(failure->particle, pair->first->size());
  }
}

TEST(Contact, DemandsFollowGapAndSpeed) {
  const auto demand_of = [](Real gap, Real speed) {
    const auto pair = test::round_pair<3>(gap);
    const auto term = test::contact_of<3>(pair, test::law<3>(), ContactForm::energy);
    const NodalVectors still = test::zeros(pair.random(1, 1));
    NodalVectors v = still;
    for (Index A = 0; A < pair.first->size(); ++A) at(v, A) = Lanes(speed, 0, 0, 0);
    return test::report_of(*term, still, v).demand;
  };
  const StepDemand wide = demand_of(0.4, 1), narrow = demand_of(0.2, 1), fast = demand_of(0.4, 10);
  EXPECT_GT(narrow.stiffness, 100 * wide.stiffness);
  EXPECT_LT(narrow.longest, wide.longest);
  EXPECT_NEAR(fast.longest, 0.1 * wide.longest, 1e-10);
  EXPECT_GT(wide.longest, 0.05 * 0.4 / (1 + 1e-9));
  const StepDemand far = demand_of(5, 1);
  EXPECT_EQ(far.stiffness, 0);
  EXPECT_GT(far.longest, wide.longest);
}

TEST(Contact, RefusesWhatItCannotDo) {
  const auto pair = test::round_pair<2>(0.35);
  ContactLaw uncut = test::law<2>();
  uncut.cutoff = std::numeric_limits<Real>::infinity();
  EXPECT_THROW_WITH(test::contact_of<2>(pair, uncut, ContactForm::energy), InputError,
                    "needs a cut-off");
  EXPECT_THROW_WITH(test::contact_of<2>(pair, test::law<3>(), ContactForm::energy), InputError,
                    "another dimension");
  MovingPartner<2> plate;
  plate.shape = rigid_half_space<2>(uncut, 1, Vec<2>(0, -1.5), Vec<2>(0, 1));
  ContactChoice choice;
  choice.form = ContactForm::volume;
  EXPECT_THROW_WITH(rigid_contact<2>({*pair.first, 1}, std::move(plate), uncut, choice), InputError,
                    "form = \"volume\" is for two deformable bodies");
}

}  // namespace
}  // namespace meniscus::test_contact
