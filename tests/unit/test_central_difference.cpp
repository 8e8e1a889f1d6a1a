// SPDX-License-Identifier: BSD-3-Clause
// The time step: free fall, order of accuracy, energy, and the state after a failed step.
#include "meniscus/error.hpp"
#include "one_body.hpp"
#include "physics/loads/body_force.hpp"
#include "solve/step/central_difference.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_central_difference {
namespace {

using test::OneBody;

template <int D>
void expect_free_fall() {
  OneBody<D> one(D == 3 ? test::brick<D>({2, 2, 3}) : test::brick<D>({4, 3}), "neo_hookean");
  std::vector<Expression> g{Expression(0.3), Expression(-9.81)};
  if (D == 3) g.emplace_back(1.5);
  one.system.terms.push_back(body_force<D>(one.body(), one.body().mass, g));
  Vec<D> v0 = Vec<D>::Constant(0.7), a = Vec<D>::Constant(1.5);
  a[0] = 0.3;
  a[1] = -9.81;
  one.state.v = test::field_on<D>(one.body(), [&](const Vec<D>&) { return v0; });
  start(one.system, one.state);
  const Real dt = 1.0 / 64;
  for (int n = 0; n < 128; ++n) advance(one.system, one.state, dt);
  const Real t = one.state.time;
  ASSERT_EQ(t, 2);
  Real mass = 0;
  for (const Real m : one.system.mass) mass += m;
  const Vec<D> u = v0 * t + 0.5 * t * t * a, v = v0 + t * a;
  for (Index A = 0; A < one.body().size(); ++A) {
    EXPECT_LT((vector_at<D>(one.state.u, A) - u).norm(), 1e-11);
    EXPECT_LT((vector_at<D>(one.state.v, A) - v).norm(), 1e-11);
  }
  // The trapezoidal rule is exact for a power that is linear in time.
  EXPECT_NEAR(one.state.books.external_work, mass * a.dot(u), 1e-11 * mass);
  EXPECT_NEAR(take_ledger(one.system, one.state).kinetic, 0.5 * mass * v.squaredNorm(),
              1e-10 * mass);
}

TEST(CentralDifference, FreeFallIsExact) {
  expect_free_fall<2>();
  expect_free_fall<3>();
}

TEST(CentralDifference, ForcesOfTimeActAtTheirTime) {
  OneBody<2> one(test::brick<2>({3, 3}), "neo_hookean");
  one.system.terms.push_back(
      body_force<2>(one.body(), one.body().mass, {Expression("cos(t)"), Expression("6*t")}));
  start(one.system, one.state);
  const Real dt = 1e-3;
  for (int n = 0; n < 1000; ++n) advance(one.system, one.state, dt);
  const Vec<2> u = vector_at<2>(one.state.u, 4), v = vector_at<2>(one.state.v, 4);
  EXPECT_NEAR(u[0], 1 - std::cos(1.0), 1e-7);
  EXPECT_NEAR(v[0], std::sin(1.0), 1e-7);
  EXPECT_NEAR(u[1], 1, 1.1e-6);  // sum of 6 t dt^2: relative error dt^2
  EXPECT_NEAR(v[1], 3, 1e-9);
}

/// A smooth elastic oscillation.
std::unique_ptr<OneBody<2>> oscillator(Real size) {
  auto one = std::make_unique<OneBody<2>>(test::brick<2>({5, 4}, 0.2), "neo_hookean");
  one->state.v = test::field_on<2>(one->body(), [&](const Vec<2>& X) {
    return Vec<2>(size * Vec<2>(X[0] - 0.7 * X[1], 0.2 * X[0] - 0.8 * X[1]));
  });
  return one;
}

TEST(CentralDifference, IsOfSecondOrder) {
  const auto end_state = [](int steps) {
    auto one = oscillator(0.15);
    start(one->system, one->state);
    for (int n = 0; n < steps; ++n) advance(one->system, one->state, 4.0 / steps);
    return one->state;
  };
  const State coarse = end_state(100), middle = end_state(200), fine = end_state(400);
  for (const auto part : {&State::u, &State::v}) {
    const Real first = test::norm(test::sum_of(coarse.*part, -1, middle.*part));
    const Real second = test::norm(test::sum_of(middle.*part, -1, fine.*part));
    EXPECT_GT(second, 1e-6);  // above round-off
    EXPECT_NEAR(std::log2(first / second), 2, 0.05);
  }
}

TEST(CentralDifference, KeepsEnergyOverManySteps) {
  // The oscillation is small. Otherwise energy moves into short waves, which the step resolves less
  // well.
  auto one = oscillator(0.01);
  start(one->system, one->state);
  const Real dt = 0.5 * StableStepEstimator<2>(one->system).estimate(one->state).dt;
  const Ledger begin = take_ledger(one->system, one->state);
  Real worst = 0, early = 0, late = 0;
  const int steps = 10000;
  for (int n = 0; n < steps; ++n) {
    advance(one->system, one->state, dt);
    const Real error =
        (take_ledger(one->system, one->state).balance() - begin.balance()) / begin.kinetic;
    worst = std::max(worst, std::abs(error));
    if (n < steps / 4) early += error / (steps / 4);
    if (n >= steps - steps / 4) late += error / (steps / 4);
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_LT(std::abs(late - early), 1e-3);  // no drift
  const Ledger end = take_ledger(one->system, one->state);
  const Real momentum = std::sqrt(2 * begin.kinetic * 20 * 1.25);
  EXPECT_LT((end.momentum - begin.momentum).norm(), 1e-12 * momentum);
  EXPECT_LT((end.angular_momentum - begin.angular_momentum).norm(), 1e-12 * 3 * momentum);
}

/// Change of the energy balance of a stirred fluid, relative to its initial kinetic energy.
Real balance_error_of_fluid(Real fraction, int steps) {
  OneBody<2> one(test::disk(6, 3), "newtonian");
  one.state.v = test::field_on<2>(one.body(), [](const Vec<2>& X) {
    return Vec<2>(0.3 * X[0] - 0.2 * X[1], -0.3 * X[1] + 0.2 * X[0] * X[1]);
  });
  start(one.system, one.state);
  const Ledger begin = take_ledger(one.system, one.state);
  const Real dt = fraction * StableStepEstimator<2>(one.system).estimate(one.state).dt;
  for (int n = 0; n < steps; ++n) advance(one.system, one.state, dt);
  const Ledger end = take_ledger(one.system, one.state);
  EXPECT_GT(end.dissipated, 0.3 * begin.kinetic);
  return std::abs(end.balance() - begin.balance()) / begin.kinetic;
}

TEST(CentralDifference, HeatIsWhatTheFluidLoses) {
  // The viscous force lags by half a step: the error is of first order.
  const Real coarse = balance_error_of_fluid(0.2, 500), fine = balance_error_of_fluid(0.05, 2000);
  EXPECT_LT(coarse, 1e-2);
  EXPECT_LT(fine, 0.3 * coarse);
}

TEST(CentralDifference, AFailedStepPutsThePlacesBack) {
  OneBody<2> one(test::brick<2>({4, 4}), "neo_hookean");
  one.state.v = test::field_on<2>(one.body(), [](const Vec<2>& X) { return Vec<2>(-X[0], 0); });
  start(one.system, one.state);
  const NodalVectors before = one.state.u;
  try {
    advance(one.system, one.state, 1.7);
    FAIL() << "a body turned inside out was accepted";
  } catch (const SolveError& e) {
    const std::string what = e.what();
    for (const char* part : {"body 'body'", "particle", "reference position", "J = det F = -",
                             "internal force of 'body'"})
      EXPECT_NE(what.find(part), std::string::npos) << what;
  }
  EXPECT_LT(test::norm(test::sum_of(one.state.u, -1, before)), 1e-14);
  EXPECT_EQ(one.state.time, 0);
  EXPECT_EQ(one.state.step, 0);
}

/// A force that is NaN beyond x = 1.5.
class NoNumber final : public ForceTerm {
 public:
  explicit NoNumber(const Body<2>& body) : body_(body) {}
  std::string name() const override { return "no number"; }
  Report add_force(const Motion&, Forces force) override {
    for (Index A = 0; A < body_.size(); ++A)
      if (at(body_.particles.X(), A)[0] > 1.5) at(force, A).set(0, std::nan(""));
    return {};
  }

 private:
  const Body<2>& body_;
};

TEST(CentralDifference, AForceThatIsNoNumberNamesTheParticle) {
  OneBody<2> one(test::brick<2>({4, 4}), "neo_hookean");
  one.system.terms.push_back(std::make_unique<NoNumber>(one.body()));
  try {
    start(one.system, one.state);
    FAIL() << "a force that is not a number was accepted";
  } catch (const SolveError& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("not a finite number"), std::string::npos) << what;
    EXPECT_NE(what.find("reference position (2, "), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace meniscus::test_central_difference
