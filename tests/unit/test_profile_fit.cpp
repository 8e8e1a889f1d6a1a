// SPDX-License-Identifier: BSD-3-Clause
// Contact angles of surfaces that are known exactly, from points at some height above the wall.
#include "measure/profile_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace meniscus::test_profile_fit {
namespace {

constexpr Real pi = std::numbers::pi, degree = pi / 180;

template <int D>
struct Surface {
  std::vector<Vec<D>> x;
  std::vector<Real> area;
};

/// Points with distance r from the axis and height z, for 60 values of a parameter from 0 to 1.
/// curve(direction, parameter) gives r and z.
Surface<3> revolved(const std::function<Vec<2>(Real, Real)>& curve) {
  Surface<3> surface;
  for (int i = 0; i < 24; ++i)
    for (int k = 0; k < 60; ++k) {
      const Real phi = 2 * pi * i / 24;
      const Vec<2> at = curve(phi, (k + 0.5) / 60);
      surface.x.push_back({at[0] * std::cos(phi), at[0] * std::sin(phi), at[1]});
      surface.area.push_back(at[0]);
    }
  return surface;
}

const WallFrame<3> plane{Vec<3>::Zero(), Vec<3>(0, 0, 1), 0};

LineAngles fit(const Surface<3>& surface, const WallFrame<3>& wall, Real bond = 0) {
  return fit_profile<3>(surface.x, surface.area, wall, bond, {1, 0, 0});
}

TEST(ProfileFit, FindsTheAngleOfACap) {
  for (const Real theta : {15.0, 45.0, 90.0, 135.0, 165.0}) {
    const Real t = theta * degree, low = t * 0.8, high = t * 0.05;  // angles from the apex
    const LineAngles found = fit(revolved([&](Real, Real s) {
                                   const Real a = low + s * (high - low);
                                   return Vec<2>(std::sin(a), std::cos(a) - std::cos(t));
                                 }),
                                 plane);
    EXPECT_NEAR(found.mean / degree, theta, 2e-3) << theta;
    EXPECT_NEAR(found.front / degree, theta, 2e-3) << theta;
    EXPECT_NEAR(found.rear / degree, theta, 2e-3) << theta;
    EXPECT_LT(found.error, 1e-4) << theta;
  }
}

/// A sphere of radius 1 at the distance d of the centre of a ball of radius R (a cavity: R < 0).
TEST(ProfileFit, FindsTheAngleOnABallAndInACavity) {
  for (const Real R : {2.0, 0.8, -3.0})
    for (const Real theta : {60.0, 120.0}) {
      const Real c = std::cos(theta * degree);
      // cos theta = (1 + R^2 - d^2)/(2 R); z of the centre of the sphere from the top of the wall.
      const Real d = std::sqrt(1 + R * R - 2 * std::abs(R) * c * (R > 0 ? 1 : -1)),
                 z = R > 0 ? d - R : -R - d;
      const Real edge = 0.3 + z;  // the least height is 0.3 on the axis
      const LineAngles found =
          fit(revolved([&](Real, Real s) {
                const Real a = std::acos(std::clamp(edge - z - z, -0.9, 0.6)) * (1 - 0.9 * s);
                return Vec<2>(std::sin(a), z + std::cos(a));
              }),
              {Vec<3>::Zero(), Vec<3>(0, 0, 1), 1 / R});
      EXPECT_NEAR(found.mean / degree, theta, 2e-3) << R << ' ' << theta;
    }
}

/// A catenoid r = cosh(z - h) has no pressure. It meets the plane z = 0 at the slope dr/dz =
/// - sinh h.
TEST(ProfileFit, FindsTheAngleOfACatenoid) {
  for (const Real h : {0.7, -0.7}) {
    const LineAngles found = fit(revolved([&](Real, Real s) {
                                   const Real z = 0.3 + 0.4 * s;
                                   return Vec<2>(std::cosh(z - h), z);
                                 }),
                                 plane);
    EXPECT_NEAR(found.mean, std::atan2(1, std::sinh(h)), 1e-5) << h;
  }
}

/// A cylinder of radius 0.5 along z meets the plane with the normal n at the angle whose cosine is
/// n . N, N its outward normal: with n 3 degrees from z, at 87 to 93 degrees.
TEST(ProfileFit, FindsFrontAndRear) {
  const Real tilt = 3 * degree, c = std::cos(tilt), s = std::sin(tilt);
  Surface<3> surface;
  for (int i = 0; i < 24; ++i)
    for (int k = 0; k < 60; ++k) {
      const Real phi = 2 * pi * i / 24, x = 0.5 * std::cos(phi), height = 0.1 + 0.01 * k;
      surface.x.push_back({x, 0.5 * std::sin(phi), (height - s * x) / c});
      surface.area.push_back(1);
    }
  const WallFrame<3> wall{Vec<3>::Zero(), Vec<3>(s, 0, c), 0};
  const Vec<3> down(c, 0, -s);
  for (const auto& [along, front] :
       {std::pair{down, 87.0}, {Vec<3>(-down), 93.0}, {Vec<3>(0, 1, 0), 90.0}}) {
    const LineAngles found = fit_profile<3>(surface.x, surface.area, wall, 0, along);
    EXPECT_NEAR(found.mean / degree, 90, 0.1);
    EXPECT_NEAR(found.front / degree, front, 0.1);
    EXPECT_NEAR(found.rear / degree, 180 - front, 0.1);
  }
}

/// Plane drops: the curve of Young and Laplace has the first integral cos psi = c + p z - bond
/// z^2/2, from which dr/dz = cot psi.
TEST(ProfileFit, FindsTheAngleOfAPlaneDropUnderItsWeight) {
  const Real theta = 70 * degree, p = 2, bond = 1.5;
  Surface<2> surface;
  Real r = 1, z = 0;
  const int steps = 4000;
  for (int k = 0; k < steps; ++k) {
    const Real dz = 0.2 / steps, middle = z + dz / 2;
    const Real c = -std::cos(theta) - p * middle + bond * middle * middle / 2;
    r += dz * c / std::sqrt(1 - c * c);
    z += dz;
    if (z < 0.05 || k % 40 != 0) continue;
    for (const Real side : {-1.0, 1.0}) {
      surface.x.push_back({side * r, z});
      surface.area.push_back(1);
    }
  }
  const WallFrame<2> wall{Vec<2>::Zero(), Vec<2>(0, 1), 0};
  const LineAngles found = fit_profile<2>(surface.x, surface.area, wall, bond, Vec<2>(1, 0));
  EXPECT_NEAR(found.mean / degree, 70, 1e-3);
  EXPECT_NEAR(found.front / degree, 70, 1e-3);
  EXPECT_NEAR(found.rear / degree, 70, 1e-3);
}

/// A plane drop that is pushed along the wall: p grows by 0.1 per length along x. Both sides are
/// integrated from the wall.
TEST(ProfileFit, FindsBothAnglesOfAPushedPlaneDrop) {
  const Real push = 0.1, p = 1.2, front = 80, rear = 75;
  Surface<2> surface;
  for (const Real side : {1.0, -1.0}) {
    Vec<2> x(0.7, 0);
    Real angle = pi - (side > 0 ? front : rear) * degree;
    const Real ds = 1e-4;
    for (int k = 0; k < 6000; ++k) {
      const auto bend = [&](Real r) { return p + push * side * r; };
      const Real middle = angle + ds / 2 * bend(x[0]);
      x += ds * Vec<2>(std::cos(middle), std::sin(middle));
      angle += ds * bend(x[0] - ds / 2 * std::cos(middle));
      if (x[1] < 0.1 || k % 50 != 0) continue;
      surface.x.push_back({side * x[0], x[1]});
      surface.area.push_back(1);
    }
  }
  const WallFrame<2> wall{Vec<2>::Zero(), Vec<2>(0, 1), 0};
  const LineAngles found = fit_profile<2>(surface.x, surface.area, wall, 0, Vec<2>(1, 0));
  EXPECT_NEAR(found.front / degree, front, 0.05);
  EXPECT_NEAR(found.rear / degree, rear, 0.05);
}

TEST(ProfileFit, TellsItsDistanceFromTheSurface) {
  const Real depth = 1e-2;
  const LineAngles found =
      fit(revolved([&](Real, Real s) { return Vec<2>(1 + depth * std::sin(8 * pi * s), 0.1 + s); }),
          plane);
  EXPECT_NEAR(found.error, depth / std::sqrt(2), 0.2 * depth);
}

}  // namespace
}  // namespace meniscus::test_profile_fit
