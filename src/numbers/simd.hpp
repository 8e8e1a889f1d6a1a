// SPDX-License-Identifier: BSD-3-Clause
// Four doubles that are computed together. The compiler maps them to one AVX register, or to two
// registers of SSE or NEON, with the same arithmetic. A few operations have no portable form in
// g++: they use AVX instructions where available, else plain C++.
#pragma once
#include "numbers/types.hpp"

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <array>
#include <bit>
#include <cmath>

namespace meniscus {

/// Four numbers; operators work lane by lane.
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

/// The first three lanes as a vector.
inline Eigen::Vector3d spatial(const Lanes& x) {
  return {x[0], x[1], x[2]};
}

/// Lane by lane `mask ? yes : no`.
inline Lanes select(Lanes::Mask mask, Lanes yes, Lanes no) {
  return mask ? yes.v : no.v;
}

/// Lane by lane; b if either is NaN.
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

/// Lane by lane.
inline Lanes sqrt(Lanes a) {
#ifdef __AVX__
  return Lanes::Native(_mm256_sqrt_pd(a.v));
#else
  return {std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

/// Bit l is set if the mask is set in lane l.
inline unsigned lane_bits(Lanes::Mask mask) {
#ifdef __AVX__
  return static_cast<unsigned>(_mm256_movemask_pd(std::bit_cast<__m256d>(mask)));
#else
  unsigned bits = 0;
  for (unsigned lane = 0; lane < Lanes::width; ++lane) bits |= unsigned{mask[lane] != 0} << lane;
  return bits;
#endif
}

/// True if the mask is set in any lane.
inline bool any(Lanes::Mask mask) {
  return lane_bits(mask) != 0;
}

/// Returns a, kept in a register from here on. Without this the compiler reads a factor of several
/// products from memory each time.
[[gnu::always_inline]] inline Lanes in_register(Lanes a) {
#ifdef __AVX__
  asm("" : "+x"(a.v));
#endif
  return a;
}

/// Prefetches the cache line of `p` into the second-level cache. The first level has few places for
/// lines on their way: when all are taken, ordinary reads wait too (performance note 2).
/// always_inline is needed: g++ 12 would drop the call of a function without visible effect.
[[gnu::always_inline]] inline void prefetch(const void* p) {
  __builtin_prefetch(p, 0, 2);
}

/// The vectors (a_q, b_q, c_q, 0) of the lanes q = 0 ... 3.
inline std::array<Lanes, 4> by_lane(Lanes a, Lanes b, Lanes c) {
  const Lanes::Native zero{};
  const Lanes::Native ab0 = __builtin_shufflevector(a.v, b.v, 0, 4, 2, 6);
  const Lanes::Native ab1 = __builtin_shufflevector(a.v, b.v, 1, 5, 3, 7);
  const Lanes::Native c0 = __builtin_shufflevector(c.v, zero, 0, 4, 2, 6);
  const Lanes::Native c1 = __builtin_shufflevector(c.v, zero, 1, 5, 3, 7);
  return {
      __builtin_shufflevector(ab0, c0, 0, 1, 4, 5), __builtin_shufflevector(ab1, c1, 0, 1, 4, 5),
      __builtin_shufflevector(ab0, c0, 2, 3, 6, 7), __builtin_shufflevector(ab1, c1, 2, 3, 6, 7)};
}

/// (sum of the lanes of a, of b, of c, of d).
inline Lanes sums(Lanes a, Lanes b, Lanes c, Lanes d) {
  const Lanes::Native ab =
      __builtin_shufflevector(a.v, b.v, 0, 4, 2, 6) + __builtin_shufflevector(a.v, b.v, 1, 5, 3, 7);
  const Lanes::Native cd =
      __builtin_shufflevector(c.v, d.v, 0, 4, 2, 6) + __builtin_shufflevector(c.v, d.v, 1, 5, 3, 7);
  return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
}

}  // namespace meniscus
