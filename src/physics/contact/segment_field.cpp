// SPDX-License-Identifier: BSD-3-Clause
// F_p = INT (X^2 + h^2)^(-p/2) dX over a segment, for the four powers of u and psi.
//
// The note's polynomials in t = X/r lose all digits where 1 - t or h is small. Here F_p is made of
// tails G_p(X) = INT_X^inf, X >= 0, that are products and sums of terms of one size, or of a Gauss
// rule where the segment is short and so the difference of two tails would cancel.
#include "meniscus/physics/segment_field.hpp"

#include "meniscus/body/gauss.hpp"
#include "meniscus/core/simd.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace meniscus {
namespace {

/// Integrals of r^-p for the powers p of u and of psi.
struct Powers {
  Real u12, u6, psi12, psi6;

  Powers& add(Real c, const Powers& f) {
    u12 += c * f.u12;
    u6 += c * f.u6;
    psi12 += c * f.psi12;
    psi6 += c * f.psi6;
    return *this;
  }
};

const GaussRule& rule() {
  static const GaussRule points = gauss_rule(20);
  return points;
}

/// The same on [0, 1], four points at once.
struct LaneRule {
  std::array<Lanes, 5> s, w;

  LaneRule() {
    for (int k = 0; k < 20; ++k) {
      at(s, k / 4).set(k % 4, (1 + at(rule().x, k)) / 2);
      at(w, k / 4).set(k % 4, at(rule().w, k) / 2);
    }
  }
};

/// Of the point (0, h) from (X, 0). std::hypot, which knows no overflow, takes a fourth of the time
/// of a frame.
Real distance(Real X, Real h) {
  return std::sqrt(X * X + h * h);
}

/// r^-p at one point, p = 9, 3, 11, 5 if odd, else 10, 4, 12, 6.
Powers at_point(bool odd, Real X, Real h) {
  const Real q = 1 / (X * X + h * h), q2 = q * q, q5 = q2 * q2 * q;
  const Real r = odd ? std::sqrt(X * X + h * h) : 1;
  return {q5 * r, q2 * r, q5 * q * r, q2 * q * r};
}

/// With w = 1/(r (r + X)), q = h^2 w = 1 - X/r and m = (p - 3)/2,
/// G_p = h^(1-p) INT_0^q (t (2 - t))^m dt = w^(m+1) sum_k binomial(m, k) 2^(m-k) (-q)^k/(m + k +
/// 1).
Powers odd_tail(Real X, Real h) {
  const Real r = distance(X, h), w = 1 / (r * (r + X)), q = h * h * w;
  const Real w2 = w * w, w4 = w2 * w2;
  const Real m3 = 2 - q * (12.0 / 5 - q * (1 - q / 7));
  const Real m4 = 16.0 / 5 - q * (16.0 / 3 - q * (24.0 / 7 - q * (1 - q / 9)));
  return {w4 * m3, w, w4 * w * m4, w2 * (1 - q / 3)};
}

/// With v = 1/(r + X) and n = p - 2, by the tangent of half the angle,
/// G_p = (2 v)^(n+1) INT_0^1 s^n/(1 + h^2 v^2 s^2)^(n+1) ds.
Powers even_tail(Real X, Real h) {
  static const LaneRule points;
  const Real v = 1 / (distance(X, h) + X), h2v2 = (h * v) * (h * v);
  Lanes f10 = Lanes::zero(), f4 = f10, f12 = f10, f6 = f10;
  for (std::size_t k = 0; k < points.s.size(); ++k) {
    const Lanes s = points.s[k], below = 1.0 / (1.0 + h2v2 * (s * s));
    const Lanes y = 2 * v * (s * below), y2 = y * y, y4 = y2 * y2, weight = points.w[k] * below;
    f10 += weight * (y4 * y4);
    f4 += weight * y2;
    f12 += weight * (y4 * y4 * y2);
    f6 += weight * y4;
  }
  return {2 * v * sum(f10), 2 * v * sum(f4), 2 * v * sum(f12), 2 * v * sum(f6)};
}

Powers tail(bool odd, Real X, Real h) {
  return odd ? odd_tail(X, h) : even_tail(X, h);
}

/// For a segment no longer than its distance from the point: 20 Gauss points are exact to rounding.
Powers short_segment(bool odd, Real begin, Real end, Real h) {
  Powers f{};
  const Real half = (end - begin) / 2, middle = (end + begin) / 2;
  for (std::size_t k = 0; k < rule().x.size(); ++k)
    f.add(half * rule().w[k], at_point(odd, middle + half * rule().x[k], h));
  return f;
}

Powers over_segment(bool odd, Real begin, Real end, Real h) {
  const Real beside = std::max({begin, -end, 0.0});
  if (end - begin <= distance(beside, h)) return short_segment(odd, begin, end, h);
  if (beside > 0) {
    const Real near = begin > 0 ? begin : -end, far = begin > 0 ? end : -begin;
    return tail(odd, near, h).add(-1, tail(odd, far, h));
  }
  Powers f{};
  return f.add(2, tail(odd, 0, h)).add(-1, tail(odd, -begin, h)).add(-1, tail(odd, end, h));
}

}  // namespace

SegmentField segment_field(const ContactLaw& law, Real begin, Real end, Real h) {
  const PairCoefficients c = pair_coefficients(law.kernel);
  const bool odd = c.odd == 1;
  const Real s = law.sigma0, b = begin / s, e = end / s, z = h / s;
  const Powers F = over_segment(odd, b, e, z);
  const Powers first = at_point(odd, b, z), last = at_point(odd, e, z);
  const Real along = c.u12 * (first.u12 - last.u12) + c.u6 * (first.u6 - last.u6);
  const Real across = z * (c.psi12 * F.psi12 + c.psi6 * F.psi6);
  const Real unit = law.epsilon * s * s * (odd ? s : 1);
  return {unit * s * (c.u12 * F.u12 + c.u6 * F.u6), unit * Vec<2>(along, across)};
}

}  // namespace meniscus
