// SPDX-License-Identifier: BSD-3-Clause
// The energy and momentum balances and their errors, against sums by hand.
#include "one_body.hpp"
#include "physics/surface/surface_tension.hpp"
#include "solve/audit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace meniscus::test_audit {
namespace {

using test::OneBody;

TEST(Audit, LedgerOfASpinningBall) {
  OneBody<3> one(test::ball(3, 2), "neo_hookean");
  one.system.terms.push_back(weak_surface_tension<3>(one.body(), 2.0, 3));
  const Vec<3> drift(0.3, -0.2, 0.5), spin(0.4, 1.1, -0.7), shift(5, -3, 2);
  one.state.u = test::field_on<3>(one.body(), [&](const Vec<3>&) { return shift; });
  one.state.v = test::field_on<3>(
      one.body(), [&](const Vec<3>& X) { return Vec<3>(drift + spin.cross(X + shift)); });
  one.state.books.dissipated = 0.25;
  one.state.books.external_work = 1.5;
  const Ledger ledger = take_ledger(one.system, one.state);

  Real kinetic = 0;
  Vec<3> momentum = Vec<3>::Zero(), angular = momentum;
  for (Index A = 0; A < one.body().size(); ++A) {
    const Real m = at(one.system.mass, A);
    const Vec<3> x = at(one.body().particles.X(), A) + shift, v = drift + spin.cross(x);
    kinetic += 0.5 * m * v.squaredNorm();
    momentum += m * v;
    angular += m * x.cross(v);
  }
  EXPECT_NEAR(ledger.kinetic, kinetic, 1e-13 * kinetic);
  EXPECT_LT((ledger.momentum - momentum).norm(), 1e-13 * momentum.norm());
  EXPECT_LT((ledger.angular_momentum - angular).norm(), 1e-13 * angular.norm());
  ASSERT_EQ(ledger.stored.size(), 2u);
  EXPECT_NEAR(ledger.stored.at("strain"), 0, 1e-12);
  EXPECT_NEAR(ledger.stored.at("surface"), 8 * M_PI, 1e-3);
  EXPECT_NEAR(ledger.balance(), kinetic + ledger.stored.at("surface") + 0.25 - 1.5,
              1e-12 * kinetic);

  // The mass equals the mass of the cells.
  Real mass = 0;
  for (const Real m : one.system.mass) mass += m;
  EXPECT_NEAR(mass, 1.25 * volume(one.body().geometry.grid), 1e-12 * mass);
}

TEST(Audit, ErrorsAreRelativeToWhatWasExchanged) {
  OneBody<2> one(test::brick<2>({4, 3}), "neo_hookean");
  one.state.v = test::field_on<2>(one.body(), [](const Vec<2>&) { return Vec<2>(2, 0); });
  Audit audit;
  Ledger ledger = take_ledger(one.system, one.state);
  one.state.books.momentum = ledger.momentum;
  one.state.books.angular_momentum = ledger.angular_momentum;
  ledger = take_ledger(one.system, one.state);
  audit.begin(ledger);
  EXPECT_EQ(audit.balance_error(ledger), 0);  // before anything was exchanged
  audit.follow(one.system, one.state, ledger);
  EXPECT_EQ(audit.balance_error(ledger), 0);
  EXPECT_EQ(audit.momentum_error(ledger), 0);
  Real mass = 0;
  for (const Real m : one.system.mass) mass += m;
  ASSERT_NEAR(ledger.kinetic, 0.5 * mass * 4, 1e-11);
  ledger.dissipated += 0.3;
  EXPECT_NEAR(audit.balance_error(ledger), 0.3 / ledger.kinetic, 1e-12);
  ledger.momentum_excess[1] += 0.06;
  EXPECT_NEAR(audit.momentum_error(ledger), 0.06 / (mass * 2), 1e-12);
  ledger.angular_momentum_excess[2] += 0.5;
  // sqrt(2 M E) times the radius of gyration of the masses
  Real spread = 0;
  for (Index A = 0; A < one.body().size(); ++A)
    spread += at(one.system.mass, A) * at(one.body().particles.X(), A).squaredNorm();
  EXPECT_NEAR(audit.angular_momentum_error(ledger), 0.5 / (mass * 2 * std::sqrt(spread / mass)),
              1e-12);
  // Scales never shrink.
  one.state.v = test::zeros(one.state.v);
  const Real scale = audit.energy_scale;
  audit.follow(one.system, one.state, take_ledger(one.system, one.state));
  EXPECT_EQ(audit.energy_scale, scale);
}

}  // namespace
}  // namespace meniscus::test_audit
