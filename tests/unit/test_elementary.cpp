// SPDX-License-Identifier: BSD-3-Clause
// log1p, expm1 and their remainders against long double arithmetic, for all scalars of the laws.
#include "numbers/elementary.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace meniscus::test_elementary {
namespace {

constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

/// Largest error of f in units of epsilon relative to `exact`, over all lanes.
template <class Function, class Exact>
Real worst_error(const std::vector<Real>& arguments, Function f, Exact exact) {
  long double worst = 0;
  const auto note = [&](long double value, Real x) {
    const long double expected = exact(static_cast<long double>(x));
    const long double error = std::abs(value - expected);
    if (error > 0) worst = std::max(worst, error / std::abs(expected) / epsilon);
  };
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const Real x = arguments[i], other = arguments[(i * 7 + 3) % arguments.size()];
    const Lanes lanes = f(Lanes(x, other, -0.0, x));
    note(f(x), x);
    note(f(Complex(x)).real(), x);
    note(lanes[0], x);
    note(lanes[1], other);
    EXPECT_EQ(lanes[0], lanes[3]);
    EXPECT_EQ(lanes[2], 0);
  }
  return static_cast<Real>(worst);
}

/// Arguments of both signs, from 1e-12 to `high` in size, but none below `low`.
std::vector<Real> arguments(Real low, Real high) {
  std::vector<Real> all;
  for (Real x = 1e-12; x < high; x *= 1.013)
    for (const Real signed_x : {x, -x})
      if (signed_x > low) all.push_back(signed_x);
  return all;
}

/// log(1 + x) - x, or e^x - 1 - x. Where the difference would cancel, by the sum over k >= 2.
long double log1p_remainder_exact(long double x) {
  if (std::abs(x) > 0.1L) return std::log1p(x) - x;
  long double sum = 0, power = -x;
  for (int k = 2; k < 40; ++k) sum += (power *= -x) / -k;
  return sum;
}

long double exp_remainder_exact(long double x) {
  if (std::abs(x) > 0.1L) return std::expm1(x) - x;
  long double sum = 0, term = x;
  for (int k = 2; k < 40; ++k) sum += term *= x / k;
  return sum;
}

TEST(Elementary, Log1p) {
  const auto f = [](auto x) { return log1p(x); };
  const auto exact = [](long double x) { return std::log1p(x); };
  EXPECT_LT(worst_error(arguments(-0.999, 50), f, exact), 2);
}

TEST(Elementary, Expm1) {
  const auto f = [](auto x) { return expm1(x); };
  const auto exact = [](long double x) { return std::expm1(x); };
  EXPECT_LT(worst_error(arguments(-700, 700), f, exact), 2);
}

TEST(Elementary, Log1pRemainder) {
  const auto f = [](auto x) { return log1p_remainder(x); };
  EXPECT_LT(worst_error(arguments(-0.999, 50), f, log1p_remainder_exact), 8);
}

TEST(Elementary, ExpRemainder) {
  const auto f = [](auto x) { return exp_remainder(x); };
  EXPECT_LT(worst_error(arguments(-700, 700), f, exp_remainder_exact), 9);
}

TEST(Elementary, ComplexStepGivesDerivatives) {
  constexpr Real step = 1e-100;
  for (const Real x : arguments(-0.999, 5)) {
    const Complex z(x, step);
    const Real slope = -x / (1 + x), growth = std::expm1(x);
    EXPECT_NEAR(log1p(z).imag() / step, 1 / (1 + x), 4 * epsilon / (1 + x));
    EXPECT_NEAR(log1p_remainder(z).imag() / step, slope, 8 * epsilon * (1 + std::abs(slope)));
    EXPECT_NEAR(expm1(z).imag() / step, 1 + growth, 4 * epsilon * (1 + growth));
    EXPECT_NEAR(exp_remainder(z).imag() / step, growth, 8 * epsilon * (1 + std::abs(growth)));
  }
}

TEST(Elementary, BadArgumentsAreSeenInTheirLaneOnly) {
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  const Lanes bad(nan, -1.5, 0.25, 0.25);
  EXPECT_TRUE(std::isnan(log1p(bad)[0]) && std::isnan(log1p(bad)[1]));
  EXPECT_EQ(log1p(bad)[2], log1p(Lanes(0.25))[0]);
  EXPECT_TRUE(std::isnan(expm1(bad)[0]) && std::isnan(exp_remainder(bad)[0]));
  EXPECT_EQ(expm1(bad)[3], expm1(Lanes(0.25))[0]);
  EXPECT_EQ(expm1(Lanes(-1e9))[0], -1);
  EXPECT_GT(expm1(Lanes(1e9))[0], 1e307);
}

}  // namespace
}  // namespace meniscus::test_elementary
