// SPDX-License-Identifier: BSD-3-Clause
// Shape functions at single points: reference values, and lanes that do not influence each other.
#include "kernel/reproducing_kernel.hpp"
#include "rkpm_reference.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace meniscus::test_reproducing_kernel {
namespace {

using nlohmann::json;

/// The reference has a factor w_A in front of each kernel, which is a multiple of 0.01. Placing 100
/// w_A particles at one position has the same effect, since a common factor cancels.
template <int D>
struct Weighted {
  std::vector<Candidate<D>> candidates;
  std::vector<std::size_t> first;  // [particle]
  std::vector<int> copies;
};

template <int D>
Weighted<D> weighted_candidates(const json& in) {
  const auto X = test::points_of<D>(in.at("XA"));
  Weighted<D> all;
  for (std::size_t A = 0; A < X.size(); ++A) {
    all.first.push_back(all.candidates.size());
    all.copies.push_back(static_cast<int>(std::lround(100 * in.at("w").at(A).get<Real>())));
    for (int n = 0; n < all.copies.back(); ++n)
      all.candidates.push_back({static_cast<Index>(A), in.at("rho").at(A).get<Real>(), X[A]});
  }
  return all;
}

template <int D, int Degree>
void expect_reference(const json& test) {
  SCOPED_TRACE(test.at("name").get<std::string>());
  const json& in = test.at("inputs");
  const json& value = test.at("value");
  const auto all = weighted_candidates<D>(in);
  const Vec<D> x = test::points_of<D>(json::array({in.at("x")})).front();
  const Vec<D> other = x + Vec<D>::Constant(0.1);
  ReproducingKernel<D, Degree> kernel(test::function_called(in.at("window")));
  kernel.evaluate({other, other, x, other}, all.candidates, Derivatives::second);
  for (std::size_t A = 0; A < all.first.size(); ++A) {
    const std::size_t k = all.first[A];
    EXPECT_NEAR(all.copies[A] * kernel.value(k)[2], value.at("N").at(A).get<Real>(), 1e-12);
    for (int i = 0; i < D; ++i)
      EXPECT_NEAR(all.copies[A] * kernel.gradient(k, i)[2],
                  value.at("dN").at(A).at(static_cast<std::size_t>(i)).get<Real>(), 1e-11);
    for (int ij = 0; ij < hessian_count(D); ++ij)
      EXPECT_NEAR(all.copies[A] * kernel.hessian(k, ij)[2],
                  value.at("d2N").at(A).at(static_cast<std::size_t>(ij)).get<Real>(), 1e-10);
  }
}

TEST(ReproducingKernel, MatchesReference) {
  const auto cases = test::rkpm_cases("shape/");
  ASSERT_EQ(cases.size(), 19u);
  for (const json& test : cases) {
    const bool plane = test.at("inputs").at("x").size() == 2;
    const bool linear = test.at("inputs").at("order") == 1;
    if (plane && linear) expect_reference<2, 1>(test);
    if (plane && !linear) expect_reference<2, 2>(test);
    if (!plane && linear) expect_reference<3, 1>(test);
    if (!plane && !linear) expect_reference<3, 2>(test);
  }
}

bool same_bits(Real a, Real b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

template <int D>
std::vector<Candidate<D>> lattice(int n, Real support) {
  std::vector<Candidate<D>> all;
  for (int k = 0; k < (D == 3 ? n * n * n : n * n); ++k) {
    Vec<D> X;
    for (int i = 0, rest = k; i < D; ++i, rest /= n) X[i] = rest % n + 0.1 * std::sin(3.0 * k + i);
    all.push_back({static_cast<Index>(k), support, X});
  }
  return all;
}

template <int D>
void expect_equal_lanes() {
  const auto candidates = lattice<D>(5, 2.7);
  const Vec<D> x = Vec<D>::Constant(1.83), y = Vec<D>::Constant(2.4), edge = Vec<D>::Constant(0.0);
  ReproducingKernel<D> alone(KernelFunction::cubic_spline), mixed(KernelFunction::cubic_spline);
  alone.evaluate({x, x, x, x}, candidates, Derivatives::second);
  const std::array<std::array<Vec<D>, 4>, 4> batches{
      {{x, y, edge, y}, {y, x, edge, edge}, {edge, y, x, y}, {y, edge, y, x}}};
  for (int lane = 0; lane < 4; ++lane) {
    mixed.evaluate(at(batches, lane), candidates, Derivatives::second);
    EXPECT_TRUE(same_bits(mixed.quality()[lane], alone.quality()[0]));
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      ASSERT_TRUE(same_bits(mixed.value(k)[lane], alone.value(k)[0]));
      ASSERT_EQ(mixed.reaches(k, lane), alone.reaches(k, 0));
      for (int i = 0; i < D; ++i)
        ASSERT_TRUE(same_bits(mixed.gradient(k, i)[lane], alone.gradient(k, i)[0]));
      for (int ij = 0; ij < hessian_count(D); ++ij)
        ASSERT_TRUE(same_bits(mixed.hessian(k, ij)[lane], alone.hessian(k, ij)[0]));
    }
  }
}

TEST(ReproducingKernel, LanesDoNotSeeEachOther) {
  expect_equal_lanes<2>();
  expect_equal_lanes<3>();
}

/// Compares derivatives with central differences of values and gradients, at a particle and beside
/// one.
template <int D, int Degree>
void expect_derivatives() {
  const auto candidates = lattice<D>(5, Degree == 3 ? 3.6 : 2.7);
  const Real h = 1e-5;
  for (const Vec<D>& x :
       {Vec<D>(candidates[candidates.size() / 2].X), Vec<D>(Vec<D>::Constant(1.6))})
    for (int j = 0; j < D; ++j) {
      const Vec<D> step = h * Vec<D>::Unit(j);
      ReproducingKernel<D, Degree> here(KernelFunction::quintic_spline),
          beside(KernelFunction::quintic_spline);
      here.evaluate({x, x, x, x}, candidates, Derivatives::second);
      beside.evaluate({Vec<D>(x - step), Vec<D>(x + step), x, x}, candidates, Derivatives::first);
      for (std::size_t k = 0; k < candidates.size(); ++k) {
        EXPECT_NEAR(here.gradient(k, j)[0], (beside.value(k)[1] - beside.value(k)[0]) / (2 * h),
                    1e-8);
        for (int i = 0; i < D; ++i)
          EXPECT_NEAR(here.hessian(k, hessian_index(D, i, j))[0],
                      (beside.gradient(k, i)[1] - beside.gradient(k, i)[0]) / (2 * h), 1e-7);
      }
    }
}

TEST(ReproducingKernel, DerivativesAreThoseOfTheValues) {
  expect_derivatives<2, 1>();
  expect_derivatives<2, 2>();
  expect_derivatives<2, 3>();
  expect_derivatives<3, 1>();
  expect_derivatives<3, 2>();
  expect_derivatives<3, 3>();
}

TEST(ReproducingKernel, QualityIsZeroOrWorseWhereNothingIsDetermined) {
  // All particles lie in a plane, so that functions of z cannot be reproduced.
  std::vector<Candidate<3>> flat;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      flat.push_back({static_cast<Index>(flat.size()), 3.0, Vec<3>(i, j, 1)});
  ReproducingKernel<3> kernel(KernelFunction::cubic_spline);
  for (const Real z : {1.0, 1.3}) {
    const Vec<3> x(2.5, 2.5, z);
    kernel.evaluate({x, x, x, x}, flat, Derivatives::none);
    EXPECT_FALSE(kernel.quality()[0] >= 1e-10) << kernel.quality()[0];
  }
  const Vec<3> far(90, 0, 0);
  kernel.evaluate({far, far, far, far}, flat, Derivatives::none);
  EXPECT_FALSE(kernel.quality()[0] >= 1e-10);
}

}  // namespace
}  // namespace meniscus::test_reproducing_kernel
