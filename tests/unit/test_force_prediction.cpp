// SPDX-License-Identifier: BSD-3-Clause
// Forces predicted from the forces of earlier steps.
#include "solve/step/force_prediction.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace meniscus::test_force_prediction {
namespace {

constexpr Index particles = 40;
const std::vector<Real> mass(particles, 0.7);

NodalVectors random(unsigned seed) {
  return test::random_field<3>(particles, 1, seed);
}

/// The error of the prediction of f(steps) from f(0) ... f(steps - 1).
template <class F>
Real error(F&& f, int steps) {
  ForcePrediction prediction(particles);
  NodalVectors next(particles);
  for (int n = 0; n < steps; ++n) {
    prediction.predict(f(n), 1, mass, next);
    prediction.step_stands();
  }
  return test::norm(test::sum_of(next, -1, f(steps)));
}

TEST(ForcePrediction, ExtrapolatesWhatIsSmooth) {
  const NodalVectors a = random(1), b = random(2), c = random(3);
  const auto parabola = [&](int n) {
    return test::sum_of(test::sum_of(a, 0.1 * n, b), 0.01 * n * n, c);
  };
  EXPECT_LT(error(parabola, 8), 1e-6 * test::norm(a));
  // After three steps the change is extrapolated; after one step it is not.
  EXPECT_LT(error(parabola, 3), 0.1 * test::norm(a));
  EXPECT_NEAR(error(parabola, 1), test::norm(test::sum_of(parabola(1), -1, parabola(0))), 1e-12);
}

TEST(ForcePrediction, DampsWhatRings) {
  const NodalVectors a = random(1);
  const auto ringing = [&](int n) { return test::sum_of(test::zeros(a), std::pow(-0.8, n), a); };
  EXPECT_LT(error(ringing, 8), 1e-6 * test::norm(a));
}

/// The prediction uses neither a jump, nor forces before a jump, nor forces of steps of another
/// length.
TEST(ForcePrediction, EndsAtAJump) {
  const NodalVectors a = random(1), b = random(2), jump = random(3);
  const auto jumping = [&](int n) {
    const NodalVectors smooth = test::sum_of(a, 1e-6 * n, b);
    return n < 6 ? smooth : test::sum_of(smooth, 1, jump);
  };
  for (const int steps : {7, 8}) EXPECT_LT(error(jumping, steps), 4e-6 * test::norm(a)) << steps;

  ForcePrediction prediction(particles);
  NodalVectors next(particles);
  for (const Real dt : {1.0, 1.0, 1.0, 1.0, 1e-3}) {
    prediction.predict(jumping(0), dt, mass, next);
    prediction.step_stands();
  }
  prediction.predict(jumping(6), 1e-3, mass, next);
  EXPECT_EQ(test::norm(test::sum_of(next, -1, jumping(6))), 0);
}

TEST(ForcePrediction, AStepThatIsTakenBackLeavesNoTrace) {
  ForcePrediction prediction(particles);
  NodalVectors next(particles), again = next;
  for (unsigned n = 1; n < 6; ++n) {
    prediction.predict(random(n), 1, mass, next);
    prediction.step_stands();
  }
  prediction.predict(random(6), 1, mass, next);
  prediction.predict(random(7), 1, mass, again);
  prediction.predict(random(6), 1, mass, again);
  EXPECT_EQ(test::norm(test::sum_of(next, -1, again)), 0);
}

}  // namespace
}  // namespace meniscus::test_force_prediction
