// SPDX-License-Identifier: BSD-3-Clause
// Integrates profiles of drops from the apex.
#include "measure/young_laplace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

namespace meniscus {
namespace {

/// At arc length s from the apex: distance r from the axis, depth z below the apex, angle phi of
/// the tangent against the plane; volume, integral of the depth over it, and area above.
struct Meridian {
  Real r = 0, z = 0, phi = 0, volume = 0, moment = 0, area = 0;

  Meridian plus(const Meridian& rate, Real ds) const {
    return {r + ds * rate.r,           z + ds * rate.z,           phi + ds * rate.phi,
            volume + ds * rate.volume, moment + ds * rate.moment, area + ds * rate.area};
  }
};

/// r' = cos phi, z' = sin phi, phi' + sin(phi)/r = (D - 1) k + bond z with the curvature k of the
/// apex; in 2D without sin(phi)/r.
template <int D>
Meridian rate(const Meridian& at, Real k, Real bond) {
  const Real c = std::cos(at.phi), s = std::sin(at.phi);
  const Real slice = (D == 3 ? std::numbers::pi * at.r : 2.0) * at.r * s;
  Meridian d{c,
             s,
             (D - 1) * k + bond * at.z,
             slice,
             slice * at.z,
             D == 3 ? 2 * std::numbers::pi * at.r : 2.0};
  if constexpr (D == 3) d.phi -= at.r > 0 ? s / at.r : k;
  return d;
}

/// The end of a profile of arc length S, by Runge and Kutta's rule of order 4.
template <int D>
Meridian end_of(Real k, Real S, Real bond) {
  constexpr int steps = 256;
  const Real ds = S / steps;
  Meridian at;
  for (int n = 0; n < steps; ++n) {
    const Meridian a = rate<D>(at, k, bond), b = rate<D>(at.plus(a, ds / 2), k, bond),
                   c = rate<D>(at.plus(b, ds / 2), k, bond), d = rate<D>(at.plus(c, ds), k, bond);
    at = at.plus(a, ds / 6).plus(b, ds / 3).plus(c, ds / 3).plus(d, ds / 6);
  }
  return at;
}

/// Curvature of the apex, and arc length.
using Unknowns = std::array<Real, 2>;

/// Newton's method for two relative errors, with differences of the function. Empty if it does not
/// converge.
std::optional<Unknowns> solve(const std::function<std::array<Real, 2>(const Unknowns&)>& error,
                              Unknowns x) {
  constexpr Real tolerance = 1e-12, increment = 1e-6;
  constexpr int most = 30;
  for (int iteration = 0; iteration < most; ++iteration) {
    const auto e = error(x);
    const Real size = std::hypot(e[0], e[1]);
    if (!(size < 1e3)) return std::nullopt;
    if (size < tolerance) return x;
    Real J[2][2];
    for (int j = 0; j < 2; ++j) {
      Unknowns up = x, down = x;
      const Real step = increment * x[static_cast<std::size_t>(j)];
      up[static_cast<std::size_t>(j)] += step;
      down[static_cast<std::size_t>(j)] -= step;
      const auto eu = error(up), ed = error(down);
      for (int i = 0; i < 2; ++i)
        J[i][j] = (eu[static_cast<std::size_t>(i)] - ed[static_cast<std::size_t>(i)]) / (2 * step);
    }
    const Real determinant = J[0][0] * J[1][1] - J[0][1] * J[1][0];
    const Unknowns change{(J[1][1] * e[0] - J[0][1] * e[1]) / determinant,
                          (J[0][0] * e[1] - J[1][0] * e[0]) / determinant};
    // A step keeps both unknowns positive.
    Real share = 1;
    for (std::size_t i = 0; i < 2; ++i)
      share = std::min(share, 0.5 * x[i] / std::max(change[i], 1e-300));
    for (std::size_t i = 0; i < 2; ++i) x[i] -= share * change[i];
    // The last digits of differences do not allow more.
    if (share == 1 && size < 1e-9 && iteration > 5) return x;
  }
  return std::nullopt;
}

/// The cap (2D: segment) on this base with this volume: its angle, by bisection.
template <int D>
Real volume_of_cap(Real theta, Real a) {
  if constexpr (D == 3) {
    const Real h = a * std::tan(theta / 2);
    return std::numbers::pi * h * (3 * a * a + h * h) / 6;
  } else {
    const Real R = a / std::sin(theta);
    return R * R * (theta - std::sin(theta) * std::cos(theta));
  }
}

template <int D>
DropProfile<D> without_profile() {
  constexpr Real missing = std::numeric_limits<Real>::quiet_NaN();
  return {missing, missing, missing, missing, missing, missing};
}

/// Raises the weight in parts, each starting from the solution of the one before.
template <int D>
DropProfile<D> raise_weight(const std::function<std::array<Real, 2>(const Meridian&)>& error_of_end,
                            Unknowns x, Real bond) {
  Real done = 0, part = 1;
  while (done < 1) {
    const Real next = std::min(done + part, 1.0);
    const auto found = solve(
        [&](const Unknowns& trial) {
          return error_of_end(end_of<D>(trial[0], trial[1], next * bond));
        },
        x);
    const Real angle = found ? end_of<D>((*found)[0], (*found)[1], next * bond).phi
                             : std::numeric_limits<Real>::max();
    if (!(angle < std::numbers::pi)) {  // no solution, or one that crosses itself
      part /= 2;
      if (part < 1e-3) return without_profile<D>();
      continue;
    }
    x = *found;
    done = next;
  }
  const Meridian end = end_of<D>(x[0], x[1], bond);
  return {end.r, end.volume, end.z, end.phi, end.area, end.z - end.moment / end.volume};
}

}  // namespace

template <int D>
DropProfile<D> profile_on(Real base_radius, Real volume, Real bond) {
  if (!(base_radius > 0) || !(volume > 0)) return without_profile<D>();
  Real low = 1e-6, high = std::numbers::pi - 1e-6;
  for (int n = 0; n < 60; ++n) {
    const Real middle = (low + high) / 2;
    (volume_of_cap<D>(middle, base_radius) < volume ? low : high) = middle;
  }
  const Real R = base_radius / std::sin(low);
  return raise_weight<D>(
      [&](const Meridian& end) {
        return std::array<Real, 2>{end.r / base_radius - 1, end.volume / volume - 1};
      },
      {1 / R, R * low}, bond);
}

template <int D>
DropProfile<D> profile_with(Real contact_angle, Real volume, Real bond) {
  if (!(contact_angle > 0) || !(contact_angle < std::numbers::pi) || !(volume > 0))
    return without_profile<D>();
  const Real unit = volume_of_cap<D>(contact_angle, std::sin(contact_angle)),
             R = D == 3 ? std::cbrt(volume / unit) : std::sqrt(volume / unit);
  return raise_weight<D>(
      [&](const Meridian& end) {
        return std::array<Real, 2>{end.phi / contact_angle - 1, end.volume / volume - 1};
      },
      {1 / R, R * contact_angle}, bond);
}

template DropProfile<2> profile_on<2>(Real, Real, Real);
template DropProfile<3> profile_on<3>(Real, Real, Real);
template DropProfile<2> profile_with<2>(Real, Real, Real);
template DropProfile<3> profile_with<3>(Real, Real, Real);

}  // namespace meniscus
