// SPDX-License-Identifier: BSD-3-Clause
// Rows of shape functions reproduce polynomials, and store only the requested derivatives.
#include "body/surface/surface_points.hpp"
#include "kernel/point_rows.hpp"
#include "meniscus/error.hpp"
#include "physics/surface/surface_tension.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

namespace meniscus::test_point_rows {
namespace {

constexpr RowContent everything{.value = true, .gradient = true, .hessian = true};

/// Largest errors of value, gradient and Hessian over all monomials up to degree 2 about the point,
/// in units of the spacing h.
struct Errors {
  Real value = 0, gradient = 0, hessian = 0;
};

template <int D>
Errors reproduction_errors(const ParticleSet<D>& particles, const std::vector<Vec<D>>& points,
                           const PointRows<D>& rows, Real h) {
  constexpr Monomials<D, 2> monomials;
  Errors worst;
  for (Index q = 0; q < rows.size(); ++q)
    for (std::size_t m = 0; m < monomials.size; ++m) {
      Real value = 0;
      Vec<D> gradient = Vec<D>::Zero();
      Mat<D> hessian = Mat<D>::Zero();
      for (Offset e = at(rows.start, q); e < at(rows.start, q + 1); ++e) {
        const Vec<D> s = (at(particles.X(), at(rows.particle, e)) - at(points, q)) / h;
        Real f = 1;
        for (int i = 0; i < D; ++i)
          for (int n = 0; n < at(monomials.exponent[m], i); ++n) f *= s[i];
        value += f * at(rows.value, e);
        for (int i = 0; i < D; ++i) {
          gradient[i] += h * f * at(rows.gradient, e * D + i);
          for (int j = 0; j < D; ++j)
            hessian(i, j) +=
                h * h * f * at(rows.hessian, e * hessian_count(D) + hessian_index(D, i, j));
        }
      }
      value -= m == 0;
      for (int i = 0; i < D; ++i) {
        gradient[i] -= m == static_cast<std::size_t>(1 + i);
        for (int j = i; j < D; ++j)
          if (m == static_cast<std::size_t>(1 + D + hessian_index(D, i, j)))
            hessian(i, j) = hessian(j, i) = hessian(i, j) - (i == j ? 2 : 1);
      }
      worst.value = std::max(worst.value, std::abs(value));
      worst.gradient = std::max(worst.gradient, gradient.cwiseAbs().maxCoeff());
      worst.hessian = std::max(worst.hessian, hessian.cwiseAbs().maxCoeff());
    }
  return worst;
}

/// Test points at particles (also at corners and edges), Gauss points of the cells, and points of
/// the surface.
template <int D>
std::vector<Vec<D>> test_points(const Geometry<D>& geometry) {
  std::vector<Vec<D>> points = geometry.grid.X;
  for (const Vec<D>& X : cell_gauss_points(geometry.grid, 2).X) points.push_back(X);
  for (const Vec<D>& X : surface_points(geometry, 2).X) points.push_back(X);
  return points;
}

template <int D>
void expect_reproduction(const Geometry<D>& geometry, KernelFunction kernel_function,
                         test::Support<D> support = {}) {
  const auto body = test::body_of<D>(geometry, support, kernel_function);
  const auto points = test_points(body->geometry);
  const auto rows = build_point_rows<D>(body->particles, points, everything, "body");
  ASSERT_EQ(rows.size(), static_cast<Index>(points.size()));
  const Real h = std::pow(volume(geometry.grid) / body->size(), 1.0 / D);
  const Errors e = reproduction_errors<D>(body->particles, points, rows, h);
  EXPECT_LT(e.value, 1e-13);
  EXPECT_LT(e.gradient, 1e-12);
  EXPECT_LT(e.hessian, 1e-11);
}

TEST(Reproduction, OnBricks) {
  for (const Real jitter : {0.0, 0.25, 0.4}) {
    SCOPED_TRACE(jitter);
    expect_reproduction<2>(test::brick<2>({9, 7}, jitter), KernelFunction::cubic_spline);
    expect_reproduction<3>(test::brick<3>({5, 6, 4}, jitter), KernelFunction::cubic_spline);
  }
}

TEST(Reproduction, OnRoundBodies) {
  expect_reproduction<2>(test::disk(8, 4), KernelFunction::cubic_spline);
  expect_reproduction<2>(test::potato<2>(), KernelFunction::cubic_spline);
  expect_reproduction<3>(test::ball(4, 2), KernelFunction::cubic_spline);
  expect_reproduction<3>(test::potato<3>(), KernelFunction::cubic_spline);
}

TEST(Reproduction, WithEveryKernelFunction) {
  // Smoother kernels need larger supports.
  for (std::size_t w = 0; w < kernel_function_names.size(); ++w) {
    SCOPED_TRACE(std::string(kernel_function_names[w]));
    expect_reproduction<2>(test::disk(6, 3), static_cast<KernelFunction>(w), {2.2, 8});
    expect_reproduction<3>(test::ball(4, 2), static_cast<KernelFunction>(w), {2.1, 20});
  }
}

template <int D>
Geometry<D> stretched(const Geometry<D>& round) {
  Mat<D> A = Mat<D>::Identity();
  A(1, 1) = 4;
  A(0, 1) = 0.7;
  return apply_map<D>(affine_map<D>(A, Vec<D>::Constant(0.3)), round);
}

/// With stretched supports, a stretched body has the shape functions of the round body.
template <int D>
void expect_functions_of(const Geometry<D>& round) {
  const Geometry<D> geometry = stretched<D>(round);
  const auto make = [](const Geometry<D>& g) {
    return ParticleSet<D>(g.grid.X, test::Support<D>{}, KernelFunction::cubic_spline,
                          mean_stretch(g.grid));
  };
  const ParticleSet<D> before = make(round), particles = make(geometry);
  EXPECT_EQ(before.pressed(), nullptr);
  ASSERT_NE(particles.pressed(), nullptr);
  const auto points = test_points(geometry);
  const auto rows = build_point_rows<D>(particles, points, everything, "body");
  const Errors e = reproduction_errors<D>(particles, points, rows, mean_spacing(geometry.grid));
  EXPECT_LT(e.value, 1e-13);
  EXPECT_LT(e.gradient, 1e-12);
  EXPECT_LT(e.hessian, 1e-11);
  const auto at_nodes = build_point_rows<D>(particles, geometry.grid.X, {.value = true}, "body"),
             as_before = build_point_rows<D>(before, round.grid.X, {.value = true}, "body");
  ASSERT_EQ(at_nodes.particle, as_before.particle);
  for (std::size_t k = 0; k < at_nodes.value.size(); ++k)
    ASSERT_NEAR(at_nodes.value[k], as_before.value[k], 1e-12);
}

TEST(Reproduction, OfSupportsThatFollowAStretch) {
  expect_functions_of<2>(test::disk(8, 4));
  expect_functions_of<3>(test::ball(4, 2));
}

TEST(Reproduction, DoesNotDependOnTheUnits) {
  // A drop of nanometres in SI, far from the origin.
  const auto shift = affine_map<3>(1e-9 * Mat<3>::Identity(), Vec<3>(5e-8, 0, -3e-8));
  expect_reproduction<3>(apply_map<3>(shift, test::ball(4, 2)), KernelFunction::cubic_spline);
}

TEST(PointRows, AreSortedAndCompressed) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const PointRows<3>& rows = body->at_particles;
  std::vector<Candidate<3>> reaching;
  for (Index q = 0; q < rows.size(); ++q) {
    body->particles.candidates(at(body->particles.X(), q), 0, reaching);
    ASSERT_EQ(at(rows.start, q + 1) - at(rows.start, q), static_cast<Offset>(reaching.size()));
    for (std::size_t k = 0; k < reaching.size(); ++k)
      ASSERT_EQ(at(rows.particle, at(rows.start, q) + static_cast<Offset>(k)),
                reaching[k].particle);
  }
  EXPECT_EQ(rows.entries(), static_cast<Offset>(rows.particle.size()));
}

TEST(PointRows, AreThoseOfEachPointHoweverManyThereAre) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const auto X = body->particles.X();
  std::vector<Vec<3>> often;  // so many points that rows are computed in several blocks
  while (often.size() < 10000) often.insert(often.end(), X.begin(), X.end());
  const PointRows<3> once = build_point_rows<3>(body->particles, X, everything, "body"),
                     rows = build_point_rows<3>(body->particles, often, everything, "body");
  ASSERT_EQ(rows.size(), static_cast<Index>(often.size()));
  for (Index q = 0; q < rows.size(); ++q) {
    const Offset first = at(once.start, q % once.size()), begin = at(rows.start, q);
    const Offset length = at(once.start, q % once.size() + 1) - first;
    ASSERT_EQ(at(rows.start, q + 1) - begin, length);
    for (Offset e = 0; e < length; ++e) {
      ASSERT_EQ(at(rows.particle, begin + e), at(once.particle, first + e));
      ASSERT_NEAR(at(rows.value, begin + e), at(once.value, first + e), 1e-12);
      for (int i = 0; i < 3; ++i)
        ASSERT_NEAR(at(rows.gradient, 3 * (begin + e) + i), at(once.gradient, 3 * (first + e) + i),
                    1e-10);
      for (int ij = 0; ij < 6; ++ij)
        ASSERT_NEAR(at(rows.hessian, 6 * (begin + e) + ij), at(once.hessian, 6 * (first + e) + ij),
                    1e-8);
    }
  }
}

TEST(PointRows, OfSomePointsHaveTheBitsThatTheyHaveAmongAll) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const auto X = body->particles.X();
  const auto n = static_cast<Index>(X.size());
  const PointRows<3> all = build_point_rows<3>(body->particles, X, everything, "body");
  for (const ItemRange some : {ItemRange{0, n}, {5, 17}, {6, 7}, {n - 3, n}, {9, 9}}) {
    SCOPED_TRACE(some.begin);
    const auto rows = build_point_rows<3>(body->particles, X, everything, "body", some);
    ASSERT_EQ(rows.size(), n);
    EXPECT_EQ(at(rows.start, some.begin), 0);
    EXPECT_EQ(at(rows.start, some.end), rows.entries());
    ASSERT_EQ(rows.entries(), at(all.start, some.end) - at(all.start, some.begin));
    for (Index q = some.begin; q <= some.end; ++q)
      ASSERT_EQ(at(rows.start, q), at(all.start, q) - at(all.start, some.begin));
    const auto expect_part = [&](const auto& part, const auto& whole, int numbers) {
      ASSERT_EQ(static_cast<Offset>(part.size()), rows.entries() * numbers);
      EXPECT_TRUE(std::equal(part.begin(), part.end(),
                             whole.begin() + at(all.start, some.begin) * numbers));
    };
    expect_part(rows.particle, all.particle, 1);
    expect_part(rows.value, all.value, 1);
    expect_part(rows.gradient, all.gradient, 3);
    expect_part(rows.hessian, all.hessian, 6);
  }
}

TEST(PointRows, HoldOnlyWhatWasAskedFor) {
  const auto body = test::body_of<3>(test::ball(4, 1));
  const auto X = body->particles.X();
  const auto build = [&](RowContent content) {
    return build_point_rows<3>(body->particles, X, content, "body");
  };
  const auto value = build({.value = true}), gradient = build({.gradient = true}),
             all = build(everything);
  const auto entries = static_cast<std::size_t>(value.entries());
  const std::size_t places = (X.size() + 1) * sizeof(Offset) + entries * sizeof(Index);
  EXPECT_EQ(value.bytes(), places + entries * 8);
  EXPECT_EQ(gradient.bytes(), places + entries * 24);
  EXPECT_EQ(all.bytes(), places + entries * (8 + 24 + 48));
  EXPECT_EQ(value.gradient.capacity() + value.hessian.capacity(), 0u);
  EXPECT_EQ(gradient.value.capacity() + gradient.hessian.capacity(), 0u);
  EXPECT_EQ(all.value.capacity(), entries);
  EXPECT_EQ(all.hessian.capacity(), 6 * entries);
  // Values do not depend on the presence of derivatives.
  EXPECT_EQ(value.value, all.value);
  EXPECT_EQ(gradient.gradient, all.gradient);
}

TEST(PointRows, SecondDerivativesExistForTheCurvatureFormOnly) {
  const auto body = test::body_of<3>(test::ball(4, 2));
  const auto weak = weak_surface_tension<3>(*body, 1.0, 3);
  const auto curvature = curvature_surface_tension<3>(*body, 1.0, 3);
  const auto triangles = triangle_surface_tension<3>(*body, 1.0);
  const auto per_pair = [](const ForceTerm& term) {
    return static_cast<Real>(term.bytes()) / static_cast<Real>(term.pairs());
  };
  EXPECT_EQ(weak->pairs(), curvature->pairs());
  // A pair has the number 4, value 8, gradient 24, second derivatives 48 bytes; the rest are points
  // and kernels.
  EXPECT_GT(per_pair(*curvature), 84);
  EXPECT_GT(curvature->bytes(), weak->bytes() + 48 * static_cast<std::size_t>(weak->pairs()));
  EXPECT_LT(per_pair(*weak), 28 + 8);
  const auto values =
      build_point_rows<3>(body->particles, body->particles.X(), {.value = true}, "");
  EXPECT_LT(static_cast<Real>(triangles->pairs()), static_cast<Real>(values.entries()));
  EXPECT_LT(per_pair(*triangles), 12 + 24);
}

TEST(PointRows, AreEmptyForNoPoints) {
  const auto body = test::body_of<2>(test::disk(4, 2));
  const auto rows = build_point_rows<2>(body->particles, {}, everything, "body");
  EXPECT_EQ(rows.size(), 0);
  EXPECT_EQ(rows.entries(), 0);
}

TEST(PointRows, RefusePointsOutOfReach) {
  const auto body = test::body_of<2>(test::disk(4, 2));
  const std::vector<Vec<2>> points{Vec<2>(0, 0), Vec<2>(0.5, 0), Vec<2>(1.9, 0)};
  try {
    build_point_rows<2>(body->particles, points, {.value = true}, "puddle");
    FAIL() << "a point that no particle determines was accepted";
  } catch (const SolveError& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("'puddle'"), std::string::npos) << what;
    EXPECT_NE(what.find("(1.9, 0)"), std::string::npos) << what;
    EXPECT_NE(what.find("neighbours"), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace meniscus::test_point_rows
