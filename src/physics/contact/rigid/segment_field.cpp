// SPDX-License-Identifier: BSD-3-Clause
// Integrals F_p = INT (X^2 + h^2)^(-p/2) dX over a segment, for the four powers of u and psi.
//
// The polynomials of the note in t = X/r lose all digits if 1 - t or h is small. Here F_p is
// computed from tails G_p(X) = INT_X^inf, X >= 0, whose terms are all of similar size. For short
// segments the difference of two tails would cancel; a Gauss rule replaces it.
#include "physics/contact/rigid/segment_field.hpp"

#include "body/grid/gauss.hpp"
#include "numbers/simd.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace meniscus {
namespace {

/// Integrals of r^-p for the powers p in u and psi. In this file T is Real or Lanes.
template <class T>
struct Powers {
  T u12, u6, psi12, psi6;

  Powers& add(T c, const Powers& f) {
    u12 += c * f.u12;
    u6 += c * f.u6;
    psi12 += c * f.psi12;
    psi6 += c * f.psi6;
    return *this;
  }
};

const GaussRule& rule() {
  const GaussRule& points = gauss_rule(20);
  return points;
}

/// Gauss rule on [0, 1] with 20 points in groups of four.
struct LaneRule {
  std::array<Lanes, 5> s, w;

  LaneRule() {
    for (int k = 0; k < 20; ++k) {
      at(s, k / 4).set(k % 4, (1 + at(rule().x, k)) / 2);
      at(w, k / 4).set(k % 4, at(rule().w, k) / 2);
    }
  }
};

/// Distance between (0, h) and (X, 0). Faster than std::hypot, whose protection from overflow is
/// not needed.
template <class T>
T distance(T X, T h) {
  using std::sqrt;
  return sqrt(X * X + h * h);
}

/// r^-p at one point: p = 9, 3, 11, 5 if odd, else p = 10, 4, 12, 6.
template <class T>
Powers<T> at_point(bool odd, T X, T h) {
  using std::sqrt;
  const T q = 1.0 / (X * X + h * h), q2 = q * q, q5 = q2 * q2 * q;
  const T r = odd ? sqrt(X * X + h * h) : T(1.0);
  return {q5 * r, q2 * r, q5 * q * r, q2 * q * r};
}

/// Tails G_p for odd p. Let w = 1/(r (r + X)), q = h^2 w = 1 - X/r and m = (p - 3)/2. Then G_p =
/// h^(1-p) INT_0^q (t (2 - t))^m dt, which is w^(m+1) sum_k binomial(m, k) 2^(m-k) (-q)^k/(m + k +
/// 1).
template <class T>
Powers<T> odd_tail(T X, T h) {
  const T r = distance(X, h), w = 1.0 / (r * (r + X)), q = h * h * w;
  const T w2 = w * w, w4 = w2 * w2;
  const T m3 = 2.0 - q * (12.0 / 5 - q * (1.0 - q / 7.0));
  const T m4 = 16.0 / 5 - q * (16.0 / 3 - q * (24.0 / 7 - q * (1.0 - q / 9.0)));
  return {w4 * m3, w, w4 * w * m4, w2 * (1.0 - q / 3.0)};
}

/// Tails G_p for even p. With v = 1/(r + X) and n = p - 2, the substitution by the tangent of half
/// the angle gives G_p = (2 v)^(n+1) INT_0^1 s^n/(1 + h^2 v^2 s^2)^(n+1) ds.
Powers<Real> even_tail(Real X, Real h) {
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

Powers<Real> tail(bool odd, Real X, Real h) {
  return odd ? odd_tail(X, h) : even_tail(X, h);
}
Powers<Lanes> tail(bool odd, Lanes X, Lanes h) {
  if (odd) return odd_tail(X, h);
  Powers<Lanes> f{};
  for (int lane = 0; lane < Lanes::width; ++lane) {
    const Powers<Real> one = even_tail(X[lane], h[lane]);
    f.u12.set(lane, one.u12);
    f.u6.set(lane, one.u6);
    f.psi12.set(lane, one.psi12);
    f.psi6.set(lane, one.psi6);
  }
  return f;
}

/// Integral over a segment no longer than its distance from the point: 20 Gauss points are exact to
/// rounding.
template <class T>
Powers<T> short_segment(bool odd, T begin, T end, T h) {
  Powers<T> f{0.0, 0.0, 0.0, 0.0};
  const T half = (end - begin) / 2.0, middle = (end + begin) / 2.0;
  for (std::size_t k = 0; k < rule().x.size(); ++k)
    f.add(half * rule().w[k], at_point(odd, T(middle + half * rule().x[k]), h));
  return f;
}

Powers<Real> over_segment(bool odd, Real begin, Real end, Real h) {
  const Real beside = std::max({begin, -end, 0.0});
  if (end - begin <= distance(beside, h)) return short_segment(odd, begin, end, h);
  if (beside > 0) {
    const Real near = begin > 0 ? begin : -end, far = begin > 0 ? end : -begin;
    return tail(odd, near, h).add(-1, tail(odd, far, h));
  }
  Powers<Real> f{};
  return f.add(2, tail(odd, 0, h)).add(-1, tail(odd, -begin, h)).add(-1, tail(odd, end, h));
}

/// Integrals for four segments. Each formula that one lane needs is computed in all lanes.
Powers<Lanes> over_segment(bool odd, Lanes begin, Lanes end, Lanes h) {
  const Lanes zero = Lanes::zero(), beside = max(max(begin, -end), zero);
  const auto few = end.v - begin.v <= distance(beside, h).v;
  Powers<Lanes> f{zero, zero, zero, zero};
  if (any(~few)) {
    const Lanes one = 1.0;
    if (any(beside.v <= 0.0)) f.add(select(beside.v > 0.0, zero, 2.0), tail(odd, zero, h));
    f.add(select(begin.v > 0.0, one, -one), tail(odd, max(begin, -begin), h));
    f.add(select(end.v < 0.0, one, -one), tail(odd, max(end, -end), h));
  }
  if (any(few)) {
    const Powers<Lanes> s = short_segment(odd, begin, end, h);
    f = {select(few, s.u12, f.u12), select(few, s.u6, f.u6), select(few, s.psi12, f.psi12),
         select(few, s.psi6, f.psi6)};
  }
  return f;
}

template <class Field, class T>
Field field_of(const ContactLaw& law, T begin, T end, T h) {
  const PairCoefficients c = pair_coefficients(law.kernel);
  const bool odd = c.odd == 1;
  const Real s = law.sigma0;
  const T b = begin / s, e = end / s, z = h / s;
  const Powers<T> F = over_segment(odd, b, e, z);
  const Powers<T> first = at_point(odd, b, z), last = at_point(odd, e, z);
  const T along = c.u12 * (first.u12 - last.u12) + c.u6 * (first.u6 - last.u6);
  const T across = z * (c.psi12 * F.psi12 + c.psi6 * F.psi6);
  const Real unit = law.epsilon * s * s * (odd ? s : 1);
  return {unit * s * (c.u12 * F.u12 + c.u6 * F.u6), {unit * along, unit * across}};
}

}  // namespace

SegmentField segment_field(const ContactLaw& law, Real begin, Real end, Real h) {
  return field_of<SegmentField>(law, begin, end, h);
}
LaneSegmentField segment_field(const ContactLaw& law, Lanes begin, Lanes end, Lanes h) {
  return field_of<LaneSegmentField>(law, begin, end, h);
}

}  // namespace meniscus
