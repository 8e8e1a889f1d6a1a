// SPDX-License-Identifier: BSD-3-Clause
// Young-Laplace: a twisted ellipsoid as reference, deformed to the unit sphere. The best fit of the
// pressure that balances surface tension is 2 gamma/R (RKPM note 4).
#include "body/surface/surface_points.hpp"
#include "physics/surface/surface_tension.hpp"
#include "unit/support.hpp"

#include <gtest/gtest.h>

namespace meniscus::verify_young_laplace {
namespace {

class YoungLaplace : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Geometry<3> sphere = test::ball(10, 5);
    order_spatially(sphere);
    const std::vector<Vec<3>> places = sphere.grid.X;
    Geometry<3> twisted = apply_map<3>(twist_ellipsoid(), std::move(sphere));
    ParticleSet<3> particles(twisted.grid.X, {2.0, 20}, KernelFunction::cubic_spline);
    body_ = std::make_unique<Body<3>>("drop", std::move(twisted), std::move(particles));
    ASSERT_EQ(body_->size(), 4341);
    u_.resize(places.size());
    for (Index A = 0; A < body_->size(); ++A)
      set_vector<3>(u_, A, Vec<3>(at(places, A) - at(body_->particles.X(), A)));
  }
  static void TearDownTestSuite() { body_.reset(); }

  /// Force of a unit pressure inside: sum_q N_A cof(F) N dA, with k x k points per facet.
  static NodalVectors unit_pressure(int k) {
    const SurfacePoints<3> surface = surface_points(body_->geometry, k);
    const auto rows =
        build_point_rows<3>(body_->particles, surface.X, {.value = true, .gradient = true}, "drop");
    NodalVectors force = test::zeros(u_);
    for (Index q = 0; q < rows.size(); ++q) {
      const auto column = gradient_at(rows, q, u_.data());
      const Tensor<Real> cof = cofactor(
          deformation_gradient(Tensor<Real>::map([&](int i, int K) { return at(column, K)[i]; })));
      Lanes n = Lanes::zero();
      for (int i = 0; i < 3; ++i)
        n.set(i, at(surface.area, q) *
                     (cof(i, 0) * at(surface.N, q)[0] + cof(i, 1) * at(surface.N, q)[1] +
                      cof(i, 2) * at(surface.N, q)[2]));
      scatter_value(rows, q, n, force.data());
    }
    return force;
  }

  /// Tests the relative error |p - 2| / 2 of the fitted pressure p, and the residual |f_s + p f_n|
  /// / |f_s|.
  static void expect_jump(ForceTerm& term, int k, Real pressure_error, Real residual) {
    const NodalVectors tension = test::force_of(term, u_), normal = unit_pressure(k);
    const Real p = -test::dot(tension, normal) / test::dot(normal, normal);
    EXPECT_LT(std::abs(p / 2 - 1), pressure_error);
    EXPECT_LT(test::norm(test::sum_of(tension, p, normal)), residual * test::norm(tension));
    RecordProperty("pressure_error", std::to_string(p / 2 - 1));
    RecordProperty("residual", std::to_string(test::norm(test::sum_of(tension, p, normal)) /
                                              test::norm(tension)));
  }

  static inline std::unique_ptr<Body<3>> body_;
  static inline NodalVectors u_;
};

TEST_F(YoungLaplace, WeakForm) {
  expect_jump(*weak_surface_tension<3>(*body_, 1, 3), 3, 1e-3, 1e-2);
}
TEST_F(YoungLaplace, WeakFormWithMorePoints) {
  expect_jump(*weak_surface_tension<3>(*body_, 1, 4), 4, 1e-3, 5e-3);
}
TEST_F(YoungLaplace, CurvatureForm) {
  expect_jump(*curvature_surface_tension<3>(*body_, 1, 3), 3, 2e-4, 2e-3);
}
TEST_F(YoungLaplace, Triangles) {
  expect_jump(*triangle_surface_tension<3>(*body_, 1), 3, 1e-2, 2e-2);
}

}  // namespace
}  // namespace meniscus::verify_young_laplace
