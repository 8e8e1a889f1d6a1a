// SPDX-License-Identifier: BSD-3-Clause
// Kernel functions: reference values, and derivatives that belong to the function.
#include "kernel/kernel_function.hpp"
#include "rkpm_reference.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_kernel_function {
namespace {

constexpr std::array all_functions{KernelFunction::cubic_spline,   KernelFunction::quintic_spline,
                                   KernelFunction::wendland_c2,    KernelFunction::wendland_c4,
                                   KernelFunction::quartic_spline, KernelFunction::triweight};

struct Values {
  Real phi, slope, bend;
};

Values at_distance(KernelFunction kernel_function, Real z) {
  return with_kernel_function(kernel_function, [&](auto w) -> Values {
    const KernelValue v = decltype(w)::at(Lanes(z, 0.3, 0.3, 0.3));
    return {v.phi[0], v.alpha[0] * z, v.alpha[0] + v.beta[0]};
  });
}

TEST(KernelFunction, MatchesReference) {
  const auto cases = test::rkpm_cases("window/");
  ASSERT_EQ(cases.size(), 25u);
  for (const auto& c : cases) {
    SCOPED_TRACE(c.at("name").get<std::string>());
    const Values got = at_distance(test::function_called(c.at("inputs").at("window")),
                                   c.at("inputs").at("z").get<Real>());
    EXPECT_NEAR(got.phi, c.at("value").at("phi").get<Real>(), 1e-13);
    EXPECT_NEAR(got.slope, c.at("value").at("dphi_dz").get<Real>(), 1e-13);
    EXPECT_NEAR(got.bend, c.at("value").at("d2phi_dz2").get<Real>(), 1e-13);
  }
}

TEST(KernelFunction, TriweightIsTheCubeOfAParabola) {
  for (const Real z : {0.0, 0.3, 0.5, 0.9}) {
    const Values got = at_distance(KernelFunction::triweight, z);
    EXPECT_NEAR(got.phi, std::pow(1 - z * z, 3), 1e-15);
    EXPECT_NEAR(got.slope, -6 * z * std::pow(1 - z * z, 2), 1e-15);
  }
  EXPECT_EQ(kernel_weight<kernel_function::Triweight>(2), 4) << "1/support^2";
  EXPECT_EQ(kernel_weight<kernel_function::CubicSpline>(2), 1);
}

/// Distances at which branches meet, and slightly beside them.
std::vector<Real> critical_distances() {
  std::vector<Real> z{1e-12, 1e-8, 1e-5, 0.01, 0.2, 0.45, 0.8, 0.99};
  for (const Real knot : {1.0 / 3, 0.5, 2.0 / 3, 1.0})
    for (const Real beside : {-1e-3, -1e-9, 1e-9, 1e-3})
      if (knot + beside < 1) z.push_back(knot + beside);
  return z;
}

TEST(KernelFunction, DerivativesAreThoseOfTheFunction) {
  for (const KernelFunction kernel_function : all_functions)
    for (const Real z : critical_distances()) {
      SCOPED_TRACE(std::string(kernel_function_names[static_cast<std::size_t>(kernel_function)]) +
                   " at " + std::to_string(z));
      const Real h = 1e-5;
      const auto phi = [&](Real x) { return at_distance(kernel_function, std::abs(x)).phi; };
      const auto slope = [&](Real x) {
        return x < 0 ? -at_distance(kernel_function, -x).slope
                     : at_distance(kernel_function, x).slope;
      };
      const Values here = at_distance(kernel_function, z);
      EXPECT_NEAR(here.slope, (phi(z + h) - phi(z - h)) / (2 * h), 1e-8);
      // Third derivatives of the cubic spline jump at its knots: the difference is of first order
      // there.
      EXPECT_NEAR(here.bend, (slope(z + h) - slope(z - h)) / (2 * h), 1e-3);
    }
}

TEST(KernelFunction, IsSmoothAtTheCentre) {
  for (const KernelFunction kernel_function : all_functions) {
    const Values centre = at_distance(kernel_function, 0),
                 near = at_distance(kernel_function, 1e-9);
    EXPECT_EQ(centre.slope, 0);
    EXPECT_TRUE(std::isfinite(centre.bend));
    EXPECT_LT(centre.bend, -1);
    EXPECT_NEAR(near.bend, centre.bend, 1e-6);
    EXPECT_NEAR(near.slope, 1e-9 * centre.bend, 1e-15);
    with_kernel_function(kernel_function, [](auto w) {
      EXPECT_EQ(decltype(w)::at(Lanes(0.0)).beta[0], 0);  // no direction at r = 0
    });
  }
}

TEST(KernelFunction, VanishesFromOneOn) {
  for (const KernelFunction kernel_function : all_functions)
    for (const Real z : {1.0, 1.0 + 1e-15, 1.5, 7.0, 1e9}) {
      const Values v = at_distance(kernel_function, z);
      EXPECT_EQ(v.phi, 0) << z;
      EXPECT_EQ(v.slope, 0) << z;
      EXPECT_EQ(v.bend, 0) << z;
    }
}

TEST(KernelFunction, IsPositiveAndFallingInside) {
  for (const KernelFunction kernel_function : all_functions)
    for (Real z = 0.01; z < 0.995; z += 0.01) {
      EXPECT_GT(at_distance(kernel_function, z).phi, 0) << z;
      EXPECT_LT(at_distance(kernel_function, z).slope, 0) << z;
    }
}

}  // namespace
}  // namespace meniscus::test_kernel_function
