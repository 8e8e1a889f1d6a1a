// SPDX-License-Identifier: BSD-3-Clause
// The stable step against dense eigenvalues, and against the growth of actual runs.
#include "meniscus/error.hpp"
#include "one_body.hpp"
#include "physics/internal/coefficient_damping.hpp"
#include "physics/surface/surface_tension.hpp"
#include "solve/least_spacing.hpp"
#include "solve/step/central_difference.hpp"
#include "solve/step/step_controller.hpp"
#include "solve/step/time_step.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <limits>

namespace meniscus::test_time_step {
namespace {

using test::OneBody;
using Matrix = Eigen::MatrixXd;

/// M^-1/2 (-d force / d field) M^-1/2 by central differences.
template <int D>
Matrix scaled_derivative(OneBody<D>& one, NodalVectors State::*field) {
  const Index n = one.system.size();
  const Real h = 1e-5;
  State state = one.state;
  NodalVectors plus(state.u.size()), minus = plus;
  Matrix K(n * D, n * D);
  for (Index B = 0; B < n; ++B)
    for (int j = 0; j < D; ++j) {
      NodalVector& x = at(state.*field, B);
      const Real here = x[j];
      x.set(j, here + h);
      one.system.add_up(state.motion(), plus);
      x.set(j, here - h);
      one.system.add_up(state.motion(), minus);
      x.set(j, here);
      for (Index A = 0; A < n; ++A)
        for (int i = 0; i < D; ++i)
          K(A * D + i, B * D + j) = (at(minus, A)[i] - at(plus, A)[i]) / (2 * h) /
                                    std::sqrt(at(one.system.mass, A) * at(one.system.mass, B));
    }
  return 0.5 * (K + K.transpose());
}

/// Largest dt with dt^2/4 K + dt/2 C <= M, by bisection.
template <int D>
Real exact_limit(OneBody<D>& one) {
  const Matrix K = scaled_derivative(one, &State::u), C = scaled_derivative(one, &State::v);
  const auto largest = [&](Real dt) {
    const Matrix sum = dt * dt / 4 * K + dt / 2 * C;
    return Eigen::SelfAdjointEigenSolver<Matrix>(sum, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
  };
  Real low = 0, high = 1;
  while (largest(high) < 1) high *= 2;
  for (int n = 0; n < 40; ++n) {
    const Real middle = 0.5 * (low + high);
    (largest(middle) < 1 ? low : high) = middle;
  }
  return low;
}

const std::string viscous = "density = 1\nbulk_modulus = 2\nviscosity = 40\n";
const std::string mixed = "density = 1\nbulk_modulus = 20\nviscosity = 1\n";

template <int D>
void expect_estimate(OneBody<D> one) {
  const Real exact = exact_limit(one);
  const StableStep found = StableStepEstimator<D>(one.system).estimate(one.state);
  EXPECT_NEAR(found.dt, exact, 0.01 * exact);
  EXPECT_NEAR(found.dt,
              4 / (found.viscosity + std::sqrt(found.viscosity * found.viscosity +
                                               4 * found.stiffness * found.stiffness)),
              1e-12 * found.dt);
  EXPECT_GT(found.evaluations, 0);
}

TEST(StableStep, IsThatOfTheDenseEigenproblem) {
  for (const std::string law : {"neo_hookean", "mooney_rivlin", "newtonian"}) {
    SCOPED_TRACE(law);
    expect_estimate<2>({test::brick<2>({4, 3}, 0.2), law});
    expect_estimate<2>({test::disk(4, 2), law});
    expect_estimate<3>({test::brick<3>({2, 2, 2}), law});
    expect_estimate<3>({test::ball(2, 1), law});
  }
  for (const std::string& text : {viscous, mixed}) {
    SCOPED_TRACE(text);
    expect_estimate<2>({test::brick<2>({4, 3}, 0.2), "newtonian", text});
    expect_estimate<3>({test::ball(2, 1), "newtonian", text});
  }
}

TEST(StableStep, FollowsADeformedState) {
  OneBody<2> one(test::brick<2>({4, 4}, 0.2), "neo_hookean");
  StableStepEstimator<2> estimator(one.system);
  const Real before = estimator.estimate(one.state).dt;
  one.state.u =
      test::field_on<2>(one.body(), [](const Vec<2>& X) { return Vec<2>(-0.6 * X[0], 0); });
  const Real exact = exact_limit(one);
  EXPECT_LT(exact, 0.95 * before);
  EXPECT_NEAR(estimator.estimate(one.state).dt, exact, 0.01 * exact);
}

TEST(StableStep, DoesNotDependOnHowLongTheModeHasBecome) {
  // Iterations lengthen the mode by about a per cent. Without normalisation it would overflow in a
  // long run.
  OneBody<3> one(test::ball(2, 1), "neo_hookean");
  StableStepEstimator<3> estimator(one.system);
  const Real first = estimator.estimate(one.state).dt;
  const auto mode = [&] {
    Snapshot kept;
    estimator.archive(Archive::writing(kept));
    return kept.reals("mode");
  };
  const auto largest = [&] {
    Real size = 0;
    for (const Real w : mode()) size = std::max(size, std::abs(w));
    return size;
  };
  // A mode_limit of 0 makes the estimator search the mode again.
  const auto begin_with = [&](const std::vector<Real>& start) {
    Snapshot kept;
    kept.add_reals("mode", start);
    kept.add_reals("mode_limit", std::vector<Real>{0});
    kept.add_reals("response_step", std::vector<Real>{0});
    kept.add_reals("response", start);
    estimator.archive(Archive::reading(kept));
  };
  for (int k = 0; k < 50; ++k) {
    begin_with(mode());
    EXPECT_NEAR(estimator.estimate(one.state).dt, first, 0.01 * first);
  }
  EXPECT_LT(largest(), 3);
  std::vector<Real> long_mode = mode();
  for (Real& w : long_mode) w *= 1e150;
  begin_with(long_mode);
  EXPECT_NEAR(estimator.estimate(one.state).dt, first, 0.01 * first);
  EXPECT_LT(largest(), 3);
}

TEST(StableStep, IsLookedForAgainWhereItsModeHasChanged) {
  OneBody<3> one(test::ball(3, 2), "neo_hookean", "density = 1\nmu = 1\nlambda = 1\n");
  StableStepEstimator<3> estimator(one.system);
  start(one.system, one.state);
  const StableStep first = estimator.estimate(one.state);
  const StableStep same = estimator.estimate_again(one.state, first);
  EXPECT_GT(first.evaluations, 4);
  EXPECT_EQ(same.evaluations, 1);
  EXPECT_NEAR(same.dt, first.dt, 1e-6 * first.dt);
  EXPECT_TRUE(same.steady);
  one.state.u =
      test::field_on<3>(one.body(), [](const Vec<3>& X) { return Vec<3>(-1e-3 * X[0], 0, 0); });
  start(one.system, one.state);
  const StableStep hardly = estimator.estimate_again(one.state, same);
  EXPECT_EQ(hardly.evaluations, 1);
  EXPECT_FALSE(hardly.steady);
  one.state.u =
      test::field_on<3>(one.body(), [](const Vec<3>& X) { return Vec<3>(-0.3 * X[0], 0, 0); });
  start(one.system, one.state);
  const StableStep pressed = estimator.estimate_again(one.state, same);
  EXPECT_GT(pressed.evaluations, 1);
  EXPECT_GT(std::abs(pressed.dt - first.dt), 0.02 * first.dt);
  const StableStep anew = StableStepEstimator<3>(one.system).estimate(one.state);
  EXPECT_NEAR(pressed.dt, anew.dt, 0.01 * anew.dt);
}

/// A term without a force that counts the calls of add_force().
class Counter final : public ForceTerm {
 public:
  explicit Counter(int& calls) : calls_(calls) {}
  std::string name() const override { return "counter"; }
  Report add_force(const Motion&, Forces) override {
    ++calls_;
    return {};
  }

 private:
  int& calls_;
};

/// The steps up to `last` at which the stable step is estimated again. The body deforms only at the
/// step `pressed_at`.
std::vector<std::int64_t> steps_of_estimates(std::int64_t last, std::int64_t pressed_at) {
  OneBody<3> one(test::ball(3, 2), "neo_hookean", "density = 1\nmu = 1\nlambda = 1\n");
  int calls = 0;
  one.system.terms.push_back(std::make_unique<Counter>(calls));
  StepController<3> controller(one.system, {.fixed = {}, .safety = 0.9});
  start(one.system, one.state);
  controller.begin(one.state);
  std::vector<std::int64_t> steps;
  for (one.state.step = 1; one.state.step <= last; ++one.state.step) {
    if (one.state.step == pressed_at) {
      one.state.u =
          test::field_on<3>(one.body(), [](const Vec<3>& X) { return Vec<3>(-1e-3 * X[0], 0, 0); });
      start(one.system, one.state);
    }
    const int before = calls;
    controller.next(one.state, 1e9);
    if (calls > before) steps.push_back(one.state.step);
  }
  return steps;
}

TEST(StepController, AsksTwiceAsFarApartWhereNothingChanges) {
  EXPECT_EQ(steps_of_estimates(400, -1), (std::vector<std::int64_t>{5, 15, 35, 75, 155, 255, 355}));
  // After a change that does not affect the limit, the interval grows by the factor 1.5 instead of
  // 2.
  EXPECT_EQ(steps_of_estimates(150, 12), (std::vector<std::int64_t>{5, 15, 30, 52, 85, 135}));
}

/// A force that is NaN on particle 3 when `broken` is true.
class Brittle final : public ForceTerm {
 public:
  explicit Brittle(const bool& broken) : broken_(broken) {}
  std::string name() const override { return "brittle"; }
  Report add_force(const Motion&, Forces force) override {
    if (broken_) force[3] += Lanes(std::numeric_limits<Real>::quiet_NaN());
    return {};
  }

 private:
  const bool& broken_;
};

TEST(StableStep, IsNotThatOfBeforeWhereAResponseIsNoNumber) {
  bool broken = false;
  OneBody<3> one(test::ball(2, 1), "neo_hookean");
  one.system.terms.push_back(std::make_unique<Brittle>(broken));
  StableStepEstimator<3> estimator(one.system);
  start(one.system, one.state);
  const StableStep found = estimator.estimate(one.state);
  EXPECT_EQ(estimator.estimate_again(one.state, found).dt, found.dt);
  broken = true;
  EXPECT_THROW(estimator.estimate_again(one.state, found), SolveError);
}

/// A ridge between two slopes under each of two particles: the force jumps at u = 0.
class Ridge final : public ForceTerm {
 public:
  std::string name() const override { return "ridge"; }
  Report add_force(const Motion& motion, Forces force) override {
    for (const std::size_t A : {3U, 7U}) force[A] += Lanes(motion.u[A][0] > 0 ? -slope : slope);
    return {};
  }
  bool may_reject_steps() const override { return may_jump; }

  Real slope = 0;
  bool may_jump = true;
};

TEST(StableStep, IsNotThatOfAJumpOfTheForce) {
  OneBody<3> one(test::ball(2, 1), "neo_hookean");
  const Real exact = exact_limit(one);
  auto added = std::make_unique<Ridge>();
  Ridge& ridge = *added;
  one.system.terms.push_back(std::move(added));
  StableStepEstimator<3> estimator(one.system);
  start(one.system, one.state);
  const StableStep smooth = estimator.estimate(one.state);
  EXPECT_NEAR(smooth.dt, exact, 0.01 * exact);
  ridge.slope = 1e-3;
  start(one.system, one.state);
  const Real again = estimator.estimate_again(one.state, smooth).dt,
             anew = StableStepEstimator<3>(one.system).estimate(one.state).dt;
  for (const Real found : {again, anew}) {  // the jump still shortens the step a little
    EXPECT_LT(found, 1.01 * exact);
    EXPECT_GT(found, 0.95 * exact);
  }
  // A term can jump without announcing it. The jump then looks like a large stiffness.
  ridge.may_jump = false;
  EXPECT_LT(StableStepEstimator<3>(one.system).estimate(one.state).dt, 0.1 * exact);
}

TEST(StableStep, FindsAModeFarFromTheOneItHad) {
  // The bar is first thinned at its left end, where its critical mode then is, and after that more
  // and more at its right end. These changes are invisible near the old critical mode.
  OneBody<2> one(test::brick<2>({24, 4}, 0.2), "neo_hookean", "density = 1\nmu = 1\nlambda = 1\n");
  StableStepEstimator<2> estimator(one.system);
  const auto press = [&](Real right) {
    one.state.u = test::field_on<2>(one.body(), [&](const Vec<2>& X) {
      const Real from_left = std::max(0.0, -X[0] / 24 - 0.1),
                 from_right = std::max(0.0, X[0] / 24 - 0.1);
      return Vec<2>(0, -(from_left + right * from_right) * X[1]);
    });
    start(one.system, one.state);
  };
  press(0);
  StableStep found = estimator.estimate(one.state);
  const Real first = found.dt;
  for (Real right = 0; right < 1.85; right += 0.1) {
    SCOPED_TRACE(right);
    press(right);
    found = estimator.estimate_again(one.state, found);
    EXPECT_LT(found.dt, 1.01 * exact_limit(one));
  }
  EXPECT_LT(found.dt, 0.7 * first);
}

/// A perfectly regular brick is pressed more and more across and less and less along. Its critical
/// mode changes to one of another symmetry, which the old mode does not contain except for
/// round-off. The change is detected by the response to a rough displacement.
TEST(StableStep, FollowsAModeThatChangesItsSymmetry) {
  OneBody<2> one(test::brick<2>({12, 6}), "neo_hookean", "density = 1\nmu = 1\nlambda = 1\n");
  StableStepEstimator<2> estimator(one.system);
  const auto press = [&](Real along, Real across) {
    one.state.u = test::field_on<2>(
        one.body(), [&](const Vec<2>& X) { return Vec<2>(-along * X[0], -across * X[1]); });
    start(one.system, one.state);
  };
  press(0.4, 0);
  StableStep found = estimator.estimate(one.state);
  for (Real across = 0.02; across < 0.4; across += 0.02) {
    SCOPED_TRACE(across);
    press(0.4 - across, across);
    found = estimator.estimate_again(one.state, found);
    EXPECT_LT(found.dt, 1.02 * exact_limit(one));
  }
}

TEST(StableStep, CountsStiffSurfaces) {
  OneBody<2> one(test::disk(4, 2), "newtonian",
                 "density = 1\nbulk_modulus = 1e-3\nviscosity = 0\n");
  one.system.terms.push_back(weak_surface_tension<2>(one.body(), 5, 3));
  const Real exact = exact_limit(one);
  EXPECT_NEAR(StableStepEstimator<2>(one.system).estimate(one.state).dt, exact, 0.01 * exact);
}

/// Largest velocity in `steps` steps from tiny disturbances, relative to the first velocity.
/// Infinite if the run failed. (A drop that has blown up may come to rest in another shape.)
template <int D>
Real growth(OneBody<D> one, Real dt, int steps) {
  one.state.v = test::random_field<D>(one.system.size(), 1e-9, 5);
  const Real first = test::norm(one.state.v);
  Real largest = first;
  try {
    start(one.system, one.state);
    for (int n = 0; n < steps; ++n) {
      advance(one.system, one.state, dt);
      largest = std::max(largest, test::norm(one.state.v));
    }
  } catch (const SolveError&) {
    return std::numeric_limits<Real>::infinity();
  }
  return largest / first;
}

template <int D>
void expect_sharp_limit(Geometry<D> geometry, const std::string& law, const std::string& text) {
  SCOPED_TRACE(law + " " + text);
  OneBody<D> one(geometry, law, text);
  const Real limit = StableStepEstimator<D>(one.system).estimate(one.state).dt;
  EXPECT_LT(growth<D>({geometry, law, text}, 0.97 * limit, 3000), 100);
  EXPECT_GT(growth<D>({geometry, law, text}, 1.05 * limit, 3000), 1e6);
}

TEST(StableStep, IsWhereCentralDifferencesBlowUp) {
  expect_sharp_limit<2>(test::brick<2>({5, 4}, 0.2), "neo_hookean",
                        test::law_texts().at("neo_hookean"));
  expect_sharp_limit<2>(test::disk(4, 2), "newtonian", viscous);
  expect_sharp_limit<2>(test::disk(4, 2), "newtonian", mixed);
  expect_sharp_limit<3>(test::ball(2, 1), "mooney_rivlin", test::law_texts().at("mooney_rivlin"));
}

/// A fluid whose stable step is limited by the damping of its coefficients.
template <int D>
OneBody<D> damped(Geometry<D> geometry) {
  OneBody<D> one(std::move(geometry), "newtonian", mixed);
  const std::vector<Real> viscosity(static_cast<std::size_t>(one.system.size()), 1);
  one.system.terms.push_back(coefficient_damping<D>(one.body(), viscosity, 200));
  return one;
}

/// Moving bodies have the same step. (At u = 0, the damping is a smooth function of u only if v =
/// 0.)
template <int D>
void expect_step_of_damping(const Geometry<D>& geometry) {
  OneBody<D> undamped(geometry, "newtonian", mixed), one = damped<D>(geometry);
  const Real exact = exact_limit(one);
  EXPECT_LT(exact, 0.5 * exact_limit(undamped));
  EXPECT_LT(growth(damped<D>(geometry), 0.97 * exact, 3000), 100);
  for (const Real speed : {0.0, 0.1}) {
    one.state.v = test::random_field<D>(one.system.size(), speed, 5);
    StepController<D> controller(one.system, {std::nullopt, 0.9, 100});
    controller.begin(one.state);
    EXPECT_NEAR(controller.stable().dt, exact, 0.01 * exact) << speed;
  }
}

TEST(StableStep, CoversStrongDampingOfCoefficients) {
  expect_step_of_damping<2>(test::disk(4, 2));
  expect_step_of_damping<3>(test::ball(2, 1));
}

TEST(LeastSpacing, IsThatOfTheClosestPairOfABody) {
  std::deque<Body<3>> bodies;
  for (const Real jitter : {0.1, 0.3}) {
    Geometry<3> geometry = test::brick<3>({5, 4, 3}, jitter);
    ParticleSet<3> particles(geometry.grid.X, test::Support<3>{}, KernelFunction::cubic_spline);
    bodies.emplace_back("brick", std::move(geometry), std::move(particles));
  }
  Real least = unbounded;
  for (const Body<3>& body : bodies)
    for (Index A = 0; A < body.size(); ++A)
      for (Index B = 0; B < A; ++B)
        least = std::min(least, (at(body.particles.X(), A) - at(body.particles.X(), B)).norm());
  EXPECT_LT(least, 0.8);
  EXPECT_DOUBLE_EQ(least_spacing(bodies), least);
}

TEST(StepController, ArrivesExactlyAndRefusesAboveTheLimit) {
  OneBody<2> one(test::brick<2>({4, 3}), "neo_hookean");
  StepController<2> automatic(one.system, {std::nullopt, 0.8, 100});
  automatic.begin(one.state);
  const Real limit = automatic.stable().dt;
  EXPECT_DOUBLE_EQ(automatic.next(one.state, 1e9), 0.8 * limit);
  const Real end = 10.3 * limit;
  Real shortest = limit;
  start(one.system, one.state);
  int steps = 0;
  while (one.state.time < end && steps < 100) {
    const Real dt = automatic.next(one.state, end);
    shortest = std::min(shortest, dt);
    advance(one.system, one.state, dt);
    ++steps;
  }
  EXPECT_EQ(one.state.time, end);
  EXPECT_EQ(steps, 13);
  EXPECT_GT(shortest, 0.35 * limit);  // the last steps are not tiny

  StepController<2> good(one.system, {0.95 * limit, 0.8, 100});
  EXPECT_NO_THROW(good.begin(one.state));
  EXPECT_EQ(good.next(one.state, 1e9), 0.95 * limit);
  StepController<2> bad(one.system, {1.03 * limit, 0.8, 100});
  try {
    bad.begin(one.state);
    FAIL() << "a step above the limit was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("stable step"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace meniscus::test_time_step
