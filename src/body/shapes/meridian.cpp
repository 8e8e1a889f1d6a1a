// SPDX-License-Identifier: BSD-3-Clause
// Meridians of rounded cylinders and spheroids.
#include "body/shapes/meridian.hpp"

#include "body/grid/gauss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meniscus {

namespace {

constexpr Real right_angle = std::numbers::pi / 2;

/// The ellipse x = a sin t, z = c cos t.
struct EllipseArc {
  Real a, c;

  /// Speed ds/dt of the arc length.
  Real speed(Real t) const { return std::hypot(a * std::cos(t), c * std::sin(t)); }

  Real arc_length(Real t) const {
    const GaussRule& rule = gauss_rule(20);
    constexpr int panels = 4;
    const Real half = t / (2 * panels);
    Real sum = 0;
    for (int panel = 0; panel < panels; ++panel)
      for (std::size_t q = 0; q < rule.x.size(); ++q)
        sum += rule.w[q] * half * speed((2 * panel + 1 + rule.x[q]) * half);
    return sum;
  }

  /// The parameter t at the arc length s, by Newton's method; the arc length is monotonic in t.
  Real parameter(Real s, Real quarter) const {
    Real t = right_angle * s / quarter;
    for (int k = 0; k < 30; ++k) {
      const Real step = (arc_length(t) - s) / speed(t);
      t = std::clamp(t - step, 0.0, right_angle);
      if (std::abs(step) < 1e-15) break;
    }
    return t;
  }

  MeridianPoint point(Real t) const {
    const Real q = speed(t), sine = std::sin(t), cosine = std::cos(t);
    return {a * sine,
            c * cosine,
            c * sine / q,
            a * cosine / q,
            a * c / (q * q * q),
            3 * a * c * (a * a - c * c) * sine * cosine / std::pow(q, 6)};
  }

  /// The parameter of the foot of a position, where its distance is stationary. Newton's method,
  /// with bisection as a safeguard.
  Real foot(const Vec<2>& place) const {
    Real low = 0, high = right_angle, t = std::atan2(place[0] / a, place[1] / c);
    for (int k = 0; k < 100; ++k) {
      const Real sine = std::sin(t), cosine = std::cos(t), excess = a * a - c * c;
      const Real f = a * place[0] * cosine - c * place[1] * sine - excess * sine * cosine;
      const Real slope =
          -a * place[0] * sine - c * place[1] * cosine - excess * (cosine * cosine - sine * sine);
      (f > 0 ? low : high) = t;
      const Real newton = t - f / slope;
      const Real next = newton >= low && newton <= high ? newton : 0.5 * (low + high);
      if (std::abs(next - t) < 1e-15) return next;
      t = next;
    }
    return t;
  }
};

}  // namespace

Meridian rounded_cylinder_meridian(Real radius, Real height, Real edge_radius) {
  const Real flat = radius - edge_radius, side = 0.5 * height - edge_radius;
  const Real arc_end = flat + right_angle * edge_radius;
  Meridian meridian;
  meridian.length = arc_end + side;
  meridian.smallest_radius = edge_radius;
  meridian.point = [=](Real s) -> MeridianPoint {
    if (s < flat) return {s, 0.5 * height, 0, 1, 0, 0};
    if (s > arc_end) return {radius, arc_end + side - s, 1, 0, 0, 0};
    const Real psi = (s - flat) / edge_radius, sine = std::sin(psi), cosine = std::cos(psi);
    return {
        flat + edge_radius * sine, side + edge_radius * cosine, sine, cosine, 1 / edge_radius, 0};
  };
  meridian.normal = [=](const Vec<2>& place) -> Vec<2> {
    return (place - Vec<2>(flat, side)).cwiseMax(0).normalized();
  };
  return meridian;
}

Meridian spheroid_meridian(Real radius, Real height) {
  const EllipseArc ellipse{radius, 0.5 * height};
  const Real a = ellipse.a, c = ellipse.c, quarter = ellipse.arc_length(right_angle);
  Meridian meridian;
  meridian.length = quarter;
  meridian.smallest_radius = std::min({c * c / a, a * a / c, a});
  meridian.point = [=](Real s) { return ellipse.point(ellipse.parameter(s, quarter)); };
  meridian.normal = [=](const Vec<2>& place) -> Vec<2> {
    const MeridianPoint foot = ellipse.point(ellipse.foot(place));
    return {foot.sin_psi, foot.cos_psi};
  };
  return meridian;
}

}  // namespace meniscus
