// SPDX-License-Identifier: BSD-3-Clause
// The four forms of surface tension: gradients of their areas, balance, exact curvature.
#include "body/surface/surface_points.hpp"
#include "meniscus/error.hpp"
#include "physics/surface/surface_tension.hpp"
#include "rkpm_reference.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace meniscus::test_surface_tension {
namespace {

enum class Form { balanced, weak, curvature, triangles };

template <int D>
std::unique_ptr<ForceTerm> tension(const Body<D>& body, Form form, Real gamma = 1, int points = 3) {
  if (form == Form::balanced) return balanced_surface_tension<D>(body, gamma);
  if (form == Form::weak) return weak_surface_tension<D>(body, gamma, points);
  if (form == Form::curvature) return curvature_surface_tension<D>(body, gamma, points);
  return triangle_surface_tension<D>(body, gamma);
}

Real measure(const ForceTerm& term, const std::string& name, const NodalVectors& u) {
  const NodalVectors v = test::zeros(u);
  for (const MeasureSource& m : term.measures())
    if (m.name == name) return m.compute({0, u, v});
  throw std::runtime_error("no measure " + name);
}

template <int D>
void expect_gradient_of_area(Geometry<D> geometry) {
  const auto body = test::body_of<D>(std::move(geometry));
  for (const Form form : {Form::balanced, Form::weak, Form::triangles}) {
    const auto term = tension<D>(*body, form, 2.5);
    for (unsigned seed = 0; seed < 3; ++seed) {
      const NodalVectors u = test::random_field<D>(body->size(), 0.03, seed);
      const NodalVectors direction = test::random_field<D>(body->size(), 1, 50 + seed);
      EXPECT_LT(test::gradient_error(*term, u, direction, 2e-4), 1e-8);
      EXPECT_DOUBLE_EQ(test::energy_of(*term, u), 2.5 * measure(*term, "area", u));
    }
  }
}

TEST(SurfaceTension, IsTheGradientOfItsArea) {
  expect_gradient_of_area<2>(test::potato<2>());
  expect_gradient_of_area<3>(test::potato<3>());
}

TEST(SurfaceTension, WeakFormsWorkOnBodiesWithEdges) {
  expect_gradient_of_area<2>(test::brick<2>({4, 3}));
  expect_gradient_of_area<3>(test::brick<3>({3, 3, 3}));
}

template <int D>
void expect_balance() {
  const auto body = test::body_of<D>(test::potato<D>());
  const NodalVectors u = test::field_on<D>(*body, [](const Vec<D>& X) {
    Vec<D> w = 0.1 * X;
    w[0] += 0.2 * std::sin(2 * X[1]);
    w[D - 1] += 0.1 * X[0] * X[0];
    return w;
  });
  for (const Form form : {Form::balanced, Form::weak, Form::triangles}) {
    const auto term = tension<D>(*body, form);
    const test::Balance net = test::balance_of<D>(*body, u, test::force_of(*term, u));
    EXPECT_LT(net.force, 1e-14);
    EXPECT_LT(net.torque, 1e-14);
  }
}

TEST(SurfaceTension, HasNoNetForceOrTorqueOnAnAsymmetricBody) {
  expect_balance<2>();
  expect_balance<3>();
}

TEST(SurfaceTension, TriangleMatchesReference) {
  const auto cases = test::rkpm_cases("surface/triangle");
  ASSERT_EQ(cases.size(), 1u);
  const auto& value = cases[0].at("value");
  const auto x = test::points_of<3>(cases[0].at("inputs").at("x"));
  const FlatPull<3> pull = flat_pull<3>({x[0], x[1], x[2]});
  EXPECT_NEAR(pull.area, value.at("area").get<Real>(), 1e-14);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(at(pull.force, k)[i], value.at("force").at(k).at(i).get<Real>(), 1e-14);
}

TEST(SurfaceTension, AreasOfRoundBodies) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const NodalVectors u(static_cast<std::size_t>(body->size()), Lanes::zero());
  const Real exact = 4 * M_PI;
  EXPECT_NEAR(measure(*tension<3>(*body, Form::balanced), "area", u), exact, 1e-10 * exact);
  EXPECT_NEAR(measure(*tension<3>(*body, Form::weak), "area", u), exact, 1e-5 * exact);
  EXPECT_NEAR(measure(*tension<3>(*body, Form::curvature), "area", u), exact, 1e-5 * exact);
  const Real triangles = measure(*tension<3>(*body, Form::triangles), "area", u);
  EXPECT_LT(triangles, exact);
  EXPECT_GT(triangles, 0.95 * exact);
  EXPECT_NEAR(measure(*tension<3>(*body, Form::curvature), "mean_curvature", u), -2, 1e-10);
  const auto round = test::body_of<2>(test::disk(6, 3));
  const NodalVectors still(static_cast<std::size_t>(round->size()), Lanes::zero());
  EXPECT_NEAR(measure(*tension<2>(*round, Form::curvature), "mean_curvature", still), -1, 1e-11);
  EXPECT_NEAR(measure(*tension<2>(*round, Form::weak), "area", still), 2 * M_PI, 1e-6);
}

/// Shape functions reproduce a map of degree 2, so that the force has the exact curvature.
template <int D>
void expect_exact_curvature(Geometry<D> geometry, Real tolerance) {
  const auto body = test::body_of<D>(std::move(geometry));
  const auto map = smooth_map<D>([](const std::array<Jet<D>, D>& X) {
    std::array<Jet<D>, D> x = X;
    x[0] = 1.2 * X[0] + 0.15 * X[1] * X[1] - 0.1 * X[0] * X[D - 1];
    x[1] = 0.9 * X[1] + 0.1 * X[0] + 0.12 * X[0] * X[0];
    if constexpr (D == 3) x[2] = 1.1 * X[2] + 0.2 * X[0] * X[1] + 0.1 * X[2] * X[2];
    return x;
  });
  const NodalVectors u =
      test::field_on<D>(*body, [&](const Vec<D>& X) { return Vec<D>(map(X).x - X); });
  const Real gamma = 0.7;
  const auto term = curvature_surface_tension<D>(*body, gamma, 3);
  const NodalVectors force = test::force_of(*term, u);

  const SurfacePoints<D> reference = surface_points(body->geometry, 3);
  SurfacePoints<D> current = reference;
  deform(current, map);
  const auto rows = build_point_rows<D>(body->particles, reference.X, {.value = true}, "body");
  NodalVectors expected = test::zeros(u);
  Real integral = 0, area = 0, largest = 0;
  for (Index q = 0; q < rows.size(); ++q) {
    const Real two_kappa = -at(current.grad_N, q).trace();
    largest = std::max(largest, std::abs(two_kappa));
    integral += two_kappa * at(current.area, q);
    area += at(current.area, q);
    for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e)
      for (int i = 0; i < D; ++i) {
        Lanes& f = at(expected, at(rows.particle, e));
        f.set(i, f[i] + at(rows.value, e) * gamma * two_kappa * at(current.area, q) *
                            at(current.N, q)[i]);
      }
  }
  EXPECT_GT(largest, 1.5 * std::abs(integral / area));  // far from a sphere
  EXPECT_LT(test::norm(test::sum_of(force, -1, expected)), tolerance * test::norm(expected));
  EXPECT_NEAR(measure(*term, "mean_curvature", u), integral / area, tolerance * largest);
  EXPECT_NEAR(measure(*term, "area", u), area, 1e-12 * area);
}

TEST(SurfaceTension, CurvatureIsExactForQuadraticMaps) {
  expect_exact_curvature<2>(test::disk(6, 3), 1e-12);
  expect_exact_curvature<2>(test::potato<2>(), 1e-12);
  expect_exact_curvature<3>(test::ball(4, 2), 1e-12);
  expect_exact_curvature<3>(test::potato<3>(), 1e-12);
}

TEST(SurfaceTension, CurvatureIsRefusedOnEdges) {
  Cylinder cylinder;
  cylinder.core = 4;
  cylinder.rings = 2;
  const auto rim = test::body_of<3>(cylinder.geometry());
  const auto square = test::body_of<2>(test::brick<2>({4, 4}));
  for (const auto& build :
       {std::function<void()>([&] { curvature_surface_tension<3>(*rim, 1, 3); }),
        std::function<void()>([&] { curvature_surface_tension<2>(*square, 1, 3); })})
    try {
      build();
      FAIL() << "accepted";
    } catch (const InputError& e) {
      const std::string what = e.what();
      EXPECT_NE(what.find("body 'body'"), std::string::npos) << what;
      EXPECT_NE(what.find("edges"), std::string::npos) << what;
      EXPECT_NE(what.find("weak"), std::string::npos) << what;
    }
}

/// On a ball the force is along the normal and points inwards.
TEST(SurfaceTension, PullsASphereInwards) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const NodalVectors u(static_cast<std::size_t>(body->size()), Lanes::zero());
  const NodalVectors radial = test::field_on<3>(*body, [](const Vec<3>& X) { return X; });
  for (const Form form : {Form::weak, Form::curvature, Form::triangles}) {
    const auto term = tension<3>(*body, form);
    // If the radius grows at the rate 1, dA/dt is 8 pi, exactly twice the area.
    EXPECT_NEAR(-test::dot(test::force_of(*term, u), radial), 2 * measure(*term, "area", u), 1e-10);
    EXPECT_EQ(term->energy_kind(), "surface");
    EXPECT_FALSE(term->viscous());
  }
}

}  // namespace
}  // namespace meniscus::test_surface_tension
