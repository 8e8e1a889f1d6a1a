// SPDX-License-Identifier: BSD-3-Clause
// Four doubles that are computed together. The compiler maps them to one AVX register, or to two
// SSE registers: the arithmetic, and so every bit of the result, is the same.
#pragma once
#include "meniscus/core/types.hpp"

#include <immintrin.h>

#include <array>
#include <cmath>

namespace meniscus {

struct Lanes {
  static constexpr int width = 4;
  using Native = Real __attribute__((vector_size(32)));
  using Mask = decltype(Native{} < Native{});

  Native v;

  Lanes() = default;
  Lanes(Native native) : v(native) {}
  Lanes(Real all) : v{all, all, all, all} {}
  Lanes(Real a, Real b, Real c, Real d) : v{a, b, c, d} {}

  static Lanes zero() { return Native{}; }
  /// `p` is aligned to 32 bytes.
  static Lanes load(const Real* p) { return *reinterpret_cast<const Native*>(p); }
  void store(Real* p) const { *reinterpret_cast<Native*>(p) = v; }

  Real operator[](int lane) const { return v[lane]; }
  void set(int lane, Real x) { v[lane] = x; }

  Lanes operator-() const { return -v; }
  Lanes& operator+=(Lanes b) {
    v += b.v;
    return *this;
  }
  Lanes& operator-=(Lanes b) {
    v -= b.v;
    return *this;
  }
  Lanes& operator*=(Lanes b) {
    v *= b.v;
    return *this;
  }
  Lanes& operator/=(Lanes b) {
    v /= b.v;
    return *this;
  }
  friend Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
  friend Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
  friend Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
  friend Lanes operator/(Lanes a, Lanes b) { return a.v / b.v; }
  friend Lanes operator+(Lanes a, Real b) { return a.v + b; }
  friend Lanes operator-(Lanes a, Real b) { return a.v - b; }
  friend Lanes operator*(Lanes a, Real b) { return a.v * b; }
  friend Lanes operator/(Lanes a, Real b) { return a.v / b; }
  friend Lanes operator+(Real a, Lanes b) { return a + b.v; }
  friend Lanes operator-(Real a, Lanes b) { return a - b.v; }
  friend Lanes operator*(Real a, Lanes b) { return a * b.v; }
  friend Lanes operator/(Real a, Lanes b) { return a / b.v; }
};

/// Lane by lane `mask ? yes : no`.
inline Lanes select(Lanes::Mask mask, Lanes yes, Lanes no) {
  return mask ? yes.v : no.v;
}
inline Lanes min(Lanes a, Lanes b) {
  return select(a.v < b.v, a, b);
}
inline Lanes max(Lanes a, Lanes b) {
  return select(a.v > b.v, a, b);
}

/// Sum of the four lanes, in a fixed order.
inline Real sum(Lanes a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

inline Lanes sqrt(Lanes a) {
  return Lanes::Native(_mm256_sqrt_pd(a.v));
}

}  // namespace meniscus
