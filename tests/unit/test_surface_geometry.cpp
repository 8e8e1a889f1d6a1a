// SPDX-License-Identifier: BSD-3-Clause
// Normal, area ratio and curvature against reference values and against identities.
#include "numbers/surface_geometry.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace meniscus::test_surface_geometry {
namespace {

using nlohmann::json;
using Vector = std::array<Real, 3>;

Tensor<Real> tensor(const json& rows) {
  return Tensor<Real>::map([&](int i, int j) { return rows.at(i).at(j).get<Real>(); });
}

std::vector<json> cases() {
  std::ifstream file(MENISCUS_TEST_DATA "/surface_curvature.json");
  return json::parse(file).at("cases").get<std::vector<json>>();
}

class SurfaceCurvature : public testing::TestWithParam<json> {};

TEST_P(SurfaceCurvature, MatchesReference) {
  const json& in = GetParam().at("inputs");
  const json& value = GetParam().at("value");
  const Real tolerance = GetParam().at("tolerance");
  const Vector N = in.at("N").get<Vector>();
  const std::array<Tensor<Real>, 3> G{tensor(in.at("G_iKL").at(0)), tensor(in.at("G_iKL").at(1)),
                                      tensor(in.at("G_iKL").at(2))};
  const Tensor<Real> grad_N = tensor(in.at("gradN"));

  const auto frame = surface_frame(tensor(in.at("F")), N);
  const Tensor<Real> nG = contract_normal(frame.n, G);
  const Tensor<Real> grad_n = normal_gradient(frame, nG, grad_N);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(at(frame.n, i), value.at("n").at(i).get<Real>(), tolerance);
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(grad_n(i, j), value.at("grad_n_spatial").at(i).at(j).get<Real>(), tolerance);
  }
  EXPECT_NEAR(frame.area_ratio, value.at("area_ratio_da_dA").get<Real>(), tolerance);
  EXPECT_NEAR(twice_mean_curvature(frame, nG, grad_N), value.at("two_kappa").get<Real>(),
              tolerance);
  EXPECT_NEAR(-trace(grad_n), value.at("two_kappa").get<Real>(), tolerance);
  EXPECT_NEAR(gauss_curvature(grad_n), value.at("gauss_curvature").get<Real>(), tolerance);
}

INSTANTIATE_TEST_SUITE_P(Reference, SurfaceCurvature, testing::ValuesIn(cases()),
                         [](const auto& test) {
                           const std::string name = test.param.at("name");
                           return name.substr(name.find('/') + 1);
                         });

TEST(SurfaceGeometry, MetricHasNormalInItsKernel) {
  const Tensor<Real> F{{{1.2, 0.3, -0.1}, {0.2, 0.9, 0.1}, {-0.3, 0.2, 1.1}}};
  const Vector N{2.0 / 3, -1.0 / 3, 2.0 / 3};
  const auto frame = surface_frame(F, N);
  for (int K = 0; K < 3; ++K)
    EXPECT_NEAR(frame.metric(K, 0) * N[0] + frame.metric(K, 1) * N[1] + frame.metric(K, 2) * N[2],
                0, 1e-15);
}

TEST(SurfaceGeometry, PlaneStrainCircleIsACylinder) {
  // A circle of radius 2 stretched to radii 3 and 2: at the end of the long axis the curvature of
  // the ellipse is a / b^2.
  const Mat<2> F = Vec<2>(1.5, 1).asDiagonal();
  const Mat<2> grad_N = Vec<2>(0, 0.5).asDiagonal();
  const auto frame = surface_frame(embed<2>(F, 1), embed<2>(Vec<2>(1, 0)));
  const Tensor<Real> flat = Tensor<Real>::zero(), grad = embed<2>(grad_N, 0);
  EXPECT_NEAR(twice_mean_curvature(frame, flat, grad), -3.0 / 4, 1e-15);
  EXPECT_NEAR(gauss_curvature(normal_gradient(frame, flat, grad)), 0, 1e-15);
  EXPECT_EQ(frame.area_ratio, 1);
}

}  // namespace
}  // namespace meniscus::test_surface_geometry
