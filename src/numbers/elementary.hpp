// SPDX-License-Identifier: BSD-3-Clause
// Elementary functions: log(1 + x), e^x - 1 and their remainders, for all scalar types of material
// laws. All are accurate near x = 0.
#pragma once
#include "numbers/simd.hpp"

#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <numbers>

namespace meniscus {

/// The scalar of complex-step derivatives.
using Complex = std::complex<Real>;

// Series that are exact to rounding near zero and, for Lanes, the reduction of any argument to that
// range. They have no branches and no calls, so values of the time loop stay in registers.
namespace series {

inline bool log_converges(Real x) {
  return x > -0.29 && x < 0.41;
}
inline bool exp_converges(Real x) {
  return x > -0.35 && x < 0.35;
}

/// atanh(z)/z - 1 with y = z^2: y/3 + y^2/5 + ... + y^10/21.
template <class T>
[[gnu::always_inline]] inline T atanh_tail(T y) {
  const T y2 = y * y, y4 = y2 * y2, y8 = y4 * y4;
  const auto four = [&](int k) {
    return (1.0 / k + y * (1.0 / (k + 2))) + y2 * (1.0 / (k + 4) + y * (1.0 / (k + 6)));
  };
  return y * ((four(3) + y4 * four(11)) + y8 * (1.0 / 19 + y * (1.0 / 21)));
}

/// log(1 + x) = 2 atanh(z), z = x/(2 + x).
template <class T>
[[gnu::always_inline]] inline T log1p(T x) {
  const T z = x / (2.0 + x);
  return 2.0 * z + (2.0 * z) * atanh_tail(z * z);
}

/// log(1 + x) - x, with x - 2 z = x z.
template <class T>
[[gnu::always_inline]] inline T log1p_remainder(T x) {
  const T z = x / (2.0 + x);
  return (2.0 * z) * atanh_tail(z * z) - x * z;
}

/// e^x - 1 - x = x^2 (1/2! + x/3! + ... + x^12/14!).
template <class T>
[[gnu::always_inline]] inline T exp_remainder(T x) {
  constexpr auto inverse_factorial = [](int n) {
    Real f = 1;
    for (int k = 2; k <= n; ++k) f *= k;
    return 1 / f;
  };
  const T x2 = x * x, x4 = x2 * x2, x8 = x4 * x4;
  const auto four = [&](int k) {
    return (inverse_factorial(k) + x * inverse_factorial(k + 1)) +
           x2 * (inverse_factorial(k + 2) + x * inverse_factorial(k + 3));
  };
  return x2 * ((four(2) + x4 * four(6)) + x8 * (four(10) + x4 * inverse_factorial(14)));
}

using Bits = std::uint64_t __attribute__((vector_size(32)));
inline constexpr Real log2_high = 0x1.62e42feep-1, log2_low = 0x1.a39ef35793c76p-33;

/// 1 + x = 2^n (1 + f) with 1 + f between sqrt(1/2) and sqrt(2); f = x exactly where n = 0.
struct LogReduction {
  Lanes n, f;

  [[gnu::always_inline]] explicit LogReduction(Lanes x) {
    constexpr std::uint64_t one = 0x3ff0000000000000, sqrt_half = 0x3fe6a09e667f3bcd;
    const Bits u = std::bit_cast<Bits>((1.0 + x).v);
    const Bits biased = (u + (one - sqrt_half)) >> 52;  // n + 1023
    const Lanes mantissa = std::bit_cast<Lanes::Native>(u - ((biased << 52) - one));
    n = std::bit_cast<Lanes::Native>(biased | 0x4330000000000000) - (0x1p52 + 1023);
    f = select(n.v == 0.0, x, mantissa - 1.0);
  }
};

/// x = n log 2 + r with |r| <= log(2)/2; `scale` = 2^n. Saturates at |x| = 709.
struct ExpReduction {
  Lanes x, r, scale;

  [[gnu::always_inline]] explicit ExpReduction(Lanes argument) {
    constexpr Real round = 0x1.8p52;        // adding it leaves n in the low bits
    x = max(-709.0, min(709.0, argument));  // in this order NaN stays NaN
    const Lanes shifted = x * std::numbers::log2e + round, n = shifted - round;
    r = (x - n * log2_high) - n * log2_low;
    scale = std::bit_cast<Lanes::Native>((std::bit_cast<Bits>(shifted.v) + 1023) << 52);
  }
};

/// `value` where 1 + x > 0, not a number elsewhere.
inline Lanes where_log_exists(Lanes x, Lanes value) {
  return select(x.v > -1.0, value, std::numeric_limits<Real>::quiet_NaN());
}

}  // namespace series

inline Real log1p(Real x) {
  return std::log1p(x);
}

/// For real part > -1.
inline Complex log1p(Complex x) {
  const Real a = x.real(), tangent = x.imag() / (1 + a);
  return {std::log1p(a) + std::log1p(tangent * tangent) / 2, std::atan(tangent)};
}

/// Relative error < 4e-16; not a number for x <= -1.
[[gnu::always_inline]] inline Lanes log1p(Lanes x) {
  const series::LogReduction l(x);
  return series::where_log_exists(
      x, l.n * series::log2_high + (l.n * series::log2_low + series::log1p(l.f)));
}

/// log(1 + x) - x, which is -x^2/2 near 0.
inline Real log1p_remainder(Real x) {
  return series::log_converges(x) ? series::log1p_remainder(x) : std::log1p(x) - x;
}

inline Complex log1p_remainder(Complex x) {
  return series::log_converges(x.real()) ? series::log1p_remainder(x) : log1p(x) - x;
}

[[gnu::always_inline]] inline Lanes log1p_remainder(Lanes x) {
  const series::LogReduction l(x);
  return series::where_log_exists(x, (l.n * series::log2_high + (l.f - x)) +
                                         (l.n * series::log2_low + series::log1p_remainder(l.f)));
}

inline Real expm1(Real x) {
  return std::expm1(x);
}

inline Complex expm1(Complex x) {
  const Real a = std::expm1(x.real()), half_sine = std::sin(x.imag() / 2);
  return {a - 2 * (1 + a) * half_sine * half_sine, (1 + a) * std::sin(x.imag())};
}

/// Relative error < 4e-16; saturates at |x| = 709.
[[gnu::always_inline]] inline Lanes expm1(Lanes x) {
  const series::ExpReduction e(x);
  return e.scale * series::exp_remainder(e.r) + (e.scale * e.r + (e.scale - 1.0));
}

/// e^x - 1 - x, which is x^2/2 near 0.
inline Real exp_remainder(Real x) {
  return series::exp_converges(x) ? series::exp_remainder(x) : std::expm1(x) - x;
}

inline Complex exp_remainder(Complex x) {
  return series::exp_converges(x.real()) ? series::exp_remainder(x) : expm1(x) - x;
}

[[gnu::always_inline]] inline Lanes exp_remainder(Lanes x) {
  const series::ExpReduction e(x);
  return e.scale * series::exp_remainder(e.r) + ((e.scale * e.r - e.x) + (e.scale - 1.0));
}

}  // namespace meniscus
